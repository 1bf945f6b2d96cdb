/* Our own router: a receiver for each input, a sender for each output link, and before the client an
 * inbox with its deliverer. -DINBOX=capacity of the inbox in messages.
 *
 * A receiver or a sender takes a message, then outputs it. It is modelled as a place for one message,
 * with the states of the process; a rendezvous moves a message from a full place to an empty one.
 * A message crosses a wire as soon as both ends are ready. Until then nothing else can use these ends,
 * so crossing at once delays nothing, and a later crossing could lead to no other final state. */
#include "network.pml"

/* 1 + destination; 0: empty, listening */
byte sender[2 * N];   /* at the start of each wire */
byte receiver[2 * N]; /* at the end of each wire */
byte client_receiver[N];
byte inbox[N]; /* number of messages */

#define AT(place) (place - 1) /* destination of the message in a place */
#define MOVE(from, to) to = from; from = 0
#define CROSS(w) \
  if \
  :: sender[w] != 0 && receiver[w] == 0 -> MOVE(sender[w], receiver[w]) \
  :: else \
  fi

/* Moves a message from its place to the sender of link k, or into the inbox. */
#define TO_LINK(place, k) \
  place != 0 && AT(place) != p && LINK(p, AT(place)) == k && sender[2 * p + k] == 0 -> \
  MOVE(place, sender[2 * p + k]); \
  CROSS(2 * p + k)
#define HAND_ON(j, k) d_step { TO_LINK(receiver[IN(p, j)], k); CROSS(IN(p, j)) }
#define KEEP(j) \
  atomic { \
    receiver[IN(p, j)] != 0 && AT(receiver[IN(p, j)]) == p -> \
    if \
    :: inbox[p] < INBOX -> inbox[p]++ \
    :: else -> goto overflow \
    fi; \
    receiver[IN(p, j)] = 0; \
    CROSS(IN(p, j)) \
  }

proctype router(byte p) {
  byte d;
end:
  do
  :: HAND_ON(0, 0)
  :: HAND_ON(0, 1)
  :: HAND_ON(1, 0)
  :: HAND_ON(1, 1)
  :: d_step { TO_LINK(client_receiver[p], 0) }
  :: d_step { TO_LINK(client_receiver[p], 1) }
  :: KEEP(0)
  :: KEEP(1)
  :: atomic {
       from_client[(client_receiver[p] == 0 -> p : N)]?d -> client_receiver[p] = d + 1; d = 0
     }
  od;
  OVERFLOW
}

proctype deliverer(byte p) {
end:
  do
  :: atomic { inbox[p] > 0 -> inbox[p]-- }; to_client[p]!p
  od
}

init {
  byte p;
  atomic {
    do
    :: p < N -> run router(p); run deliverer(p); START_CLIENT(p); p++
    :: else -> break
    od
  }
}
