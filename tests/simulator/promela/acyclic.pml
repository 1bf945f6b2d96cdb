/* Our own router: a receiver for each way in, a sender for each link out, and before the client an
 * inbox and its deliverer. -DINBOX=messages that fit into the inbox.
 *
 * A receiver or a sender takes a message, then outputs it: it is a place for one, and a rendezvous
 * moves a message from a full place to an empty one. As such places they are modelled: the states are
 * those of processes. A wire is crossed as soon as both ends can: nothing else could use either
 * meanwhile, or be kept from anything, so that putting it off would lead to no other end. */
#include "network.pml"

/* 1 + destination; 0: listens */
byte sender[2 * N];   /* of the wire of that number: at its start */
byte receiver[2 * N]; /* at its end */
byte client_receiver[N];
byte inbox[N]; /* messages */

#define AT(place) (place - 1) /* the destination of what is there */
#define MOVE(from, to) to = from; from = 0
#define CROSS(w) \
  if \
  :: sender[w] != 0 && receiver[w] == 0 -> MOVE(sender[w], receiver[w]) \
  :: else \
  fi

/* What is in a place goes to the sender of link k, or into the inbox. */
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
