/* Green's router (figures 5.12 to 5.14): senders towards the client and lower-numbered neighbours,
 * a FIFO before each; the main process outputs to higher-numbered neighbours itself.
 * -DLINK_FIFO, -DCLIENT_FIFO: capacity in messages before a link's sender and before the client's.
 * -DREFUSE: main listens to no input while any FIFO is full.
 * -DHOLD_ALL: main does not listen to its client while any FIFO is full, the client's own too. */
#include "network.pml"

#define CLIENT 2 /* the client's output, beside links 0 and 1 */
#define WAYS 3
#define WAY(p, d) (d == p -> CLIENT : LINK(p, d))
#define HAS_SENDER(p, k) ((k) == CLIENT || NEXT(p, k) < p)

#if LINK_FIFO > CLIENT_FIFO
chan fifo[N * WAYS] = [LINK_FIFO] of { byte };
#else
chan fifo[N * WAYS] = [CLIENT_FIFO] of { byte };
#endif
chan from_sender[N * WAYS] = [0] of { bit };
chan to_sender[N * WAYS] = [0] of { byte };

#define ROOM(p, k) (len(fifo[WAYS * p + (k)]) < ((k) == CLIENT -> CLIENT_FIFO : LINK_FIFO))
#define ALL_HAVE_ROOM(p) (ROOM(p, 0) && ROOM(p, 1) && ROOM(p, CLIENT))
#ifdef REFUSE
#define LISTENS(p) ALL_HAVE_ROOM(p)
#else
#define LISTENS(p) true
#endif
#if defined(HOLD_ALL) || defined(REFUSE)
#define LISTENS_TO_CLIENT(p) ALL_HAVE_ROOM(p)
#else
#define LISTENS_TO_CLIENT(p) true
#endif

/* A sender signals that it is ready after each message. For the first one, ready[] is initially true. */
#define SENDER(k, output) \
  byte d; \
  end: \
  do \
  :: to_sender[WAYS * p + k]?d -> output!d; d = 0; from_sender[WAYS * p + k]!0 \
  od

proctype link_sender(byte p, k) { SENDER(k, wire[2 * p + k]) }
proctype client_sender(byte p) { SENDER(CLIENT, to_client[p]) }

#define SERVE_SENDER(k) \
  atomic { \
    from_sender[WAYS * p + (k)]?_ -> \
    if \
    :: fifo[WAYS * p + (k)]?d -> to_sender[WAYS * p + (k)]!d; d = 0 \
    :: empty(fifo[WAYS * p + (k)]) -> ready[k] = true \
    fi \
  }

proctype router(byte p) {
  byte d, k;
  bool ready[WAYS] = true;
end:
  do /* an ALT without priorities: it allows all choices of the PRI ALT, and more */
  :: SERVE_SENDER(0)
  :: SERVE_SENDER(1)
  :: SERVE_SENDER(CLIENT)
  :: atomic {
       if
       :: wire[(LISTENS(p) -> IN(p, 0) : CLOSED)]?d
       :: wire[(LISTENS(p) -> IN(p, 1) : CLOSED)]?d
       :: from_client[(LISTENS_TO_CLIENT(p) -> p : N)]?d
       fi;
       k = WAY(p, d);
       if
       :: !HAS_SENDER(p, k) -> wire[2 * p + k]!d
       :: HAS_SENDER(p, k) && ready[k] -> ready[k] = false; to_sender[WAYS * p + k]!d
       :: HAS_SENDER(p, k) && !ready[k] && ROOM(p, k) -> fifo[WAYS * p + k]!d
       :: else -> goto overflow
       fi;
       d = 0;
       k = 0
     }
  od;
  OVERFLOW
}

init {
  byte p;
  atomic {
    do
    :: p < N ->
       run router(p);
       START_CLIENT(p);
       run client_sender(p);
       if :: HAS_SENDER(p, 0) -> run link_sender(p, 0) :: else fi;
       if :: HAS_SENDER(p, 1) -> run link_sender(p, 1) :: else fi;
       p++
    :: else -> break
    od
  }
}
