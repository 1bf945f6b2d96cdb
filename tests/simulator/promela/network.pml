/* Shared by the routers' models: four processors with two links each, the routes, the clients.
 * -DRING or -DMESH; -DW=messages that each client sends; -DRECEPTIVE: clients receive while they send;
 * -DOPPOSITE: only to the opposite corner, else to any other processor; -DUP_DOWN: on the ring, routes
 * go up and then down (root 0). This changes one route: from 1 to 3 over 0, not over 2.
 *
 * RING  0 - 1     routes go the shorter way,     MESH  0 - 1     routes go along the row,
 *       |   |     clockwise (0 1 2 3) between          |   |     then along the column
 *       3 - 2     opposite corners                     2 - 3
 *
 * Link k of processor p leads to NEXT(p, k) and is left by LINK(p, d) towards processor d;
 * wire[2 * p + k] carries what p sends there, wire[IN(p, k)] what p hears from there. Wires are links
 * of transputers: rendezvous. wire[CLOSED] is no wire: it stands for an input that is not listened to.
 */
#define N 4
#define CLOSED 8
#ifdef RING
#define NEXT(p, k) ((p + 1 + 2 * (k)) % N)
#define IN(p, k) (2 * NEXT(p, k) + 1 - (k))
#ifdef UP_DOWN
#define LINK(p, d) ((d + N - p) % N == 3 || (p == 1 && d == 3))
#else
#define LINK(p, d) ((d + N - p) % N == 3)
#endif
#else
#define NEXT(p, k) (p ^ (1 + (k)))
#define IN(p, k) (2 * NEXT(p, k) + (k))
#define LINK(p, d) (((p ^ d) & 1) == 0)
#endif

chan wire[CLOSED + 1] = [0] of { byte };   /* a message is its destination */
chan from_client[N + 1] = [0] of { byte }; /* from_client[N]: not listened to */
chan to_client[N] = [0] of { byte };
byte delivered; /* messages in total */
bool failed;    /* a buffer overflowed */

/* An overflow of a buffer ends a run here, as a fault. The assertion reports it (except with pan -A).
 * The loop prevents the search from taking the halt for a deadlock. */
#define OVERFLOW \
  overflow: \
    failed = true; \
    assert(!failed); \
    do \
    :: failed \
    od

/* Clients end once every message is delivered: waiting anywhere else is a deadlock. */
#define RECEIVE atomic { to_client[p]?eval(p) -> delivered++; assert(delivered <= N * W) }
#ifdef OPPOSITE
#ifdef RING
#define SEND from_client[p]!((p + 2) % N)
#else
#define SEND from_client[p]!(3 - p)
#endif
#else
#define SEND \
  if \
  :: from_client[p]!((p + 1) % N) \
  :: from_client[p]!((p + 2) % N) \
  :: from_client[p]!((p + 3) % N) \
  fi
#endif

#ifdef RECEPTIVE
proctype client_sends(byte p) {
  byte sent;
  do
  :: atomic { sent < W -> sent++ }; SEND
  :: sent == W -> break
  od
}

proctype client_receives(byte p) {
  do
  :: RECEIVE
  :: delivered == N * W -> break
  od
}
#define START_CLIENT(p) run client_sends(p); run client_receives(p)
#else
/* A client that sends and receives in any order, but does not receive during a send. */
proctype client(byte p) {
  byte sent;
  do
  :: RECEIVE
  :: atomic { sent < W -> sent++ }; SEND
  :: delivered == N * W -> break
  od
}
#define START_CLIENT(p) run client(p)
#endif
