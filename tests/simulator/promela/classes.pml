/* Buffer classes by hop count: a message that has made h hops waits in a buffer of class h, and moves
 * only into a free one of class h + 1; the client's come into class 0. A processor has one buffer of
 * each class 0 .. 2 (2 is the longest route), whichever link they come by. What credits tell, free
 * buffers at the neighbour, is looked at here as if it were shared: the messages that carry credits
 * are not modelled. */
#include "network.pml"

#define CLASSES 3
byte slot[N * CLASSES]; /* 1 + destination, 0: free */
#define SLOT(p, h) slot[CLASSES * (p) + (h)]
#define TO_NEIGHBOUR(h) \
  (SLOT(p, h) != 0 && SLOT(p, h) != p + 1 && SLOT(NEXT(p, LINK(p, (SLOT(p, h) - 1))), h + 1) == 0)

/* The room is claimed, the message sent and its buffer freed at once: who hears is always ready. */
#define FORWARD(h) \
  d_step { \
    TO_NEIGHBOUR(h) -> \
    SLOT(NEXT(p, LINK(p, (SLOT(p, h) - 1))), h + 1) = SLOT(p, h); \
    SLOT(p, h) = 0 \
  }

proctype router(byte p) {
  byte d;
end:
  do
  :: FORWARD(0)
  :: FORWARD(1)
  :: atomic { from_client[(SLOT(p, 0) == 0 -> p : N)]?d -> SLOT(p, 0) = d + 1; d = 0 }
  od
}

proctype delivery(byte p) {
end:
  do
  :: SLOT(p, 1) == p + 1 -> to_client[p]!p; SLOT(p, 1) = 0
  :: SLOT(p, 2) == p + 1 -> to_client[p]!p; SLOT(p, 2) = 0
  od
}

init {
  byte p;
  atomic {
    do
    :: p < N -> run router(p); run delivery(p); START_CLIENT(p); p++
    :: else -> break
    od
  }
}
