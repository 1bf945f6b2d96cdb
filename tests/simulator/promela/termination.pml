/* Termination detection of a phase (docs/manual/termination.md) by credits, which are the pixels.
 * -DW=workers; -DSINGLE, -DDOUBLE=initial cells of one and of two pixels; -DPHASES=largest number.
 * -DREQUESTS: cells move as answers to requests; else any worker sends active ones to any other.
 * Mistakes that the search must find:
 * -DNO_NUMBERS: reports do not name their phase.
 * -DSENT_RETURNS: cells that are sent away are counted as returned.
 * -DPARKED_MOVE: a parked cell is sent, once in a run, and stays counted.
 * -DNO_RECOUNT: with new limits, pixels reported under the old ones are not counted again.
 * -DEMPTY: a division can make a cell without pixels beside the others.
 * -DPATIENT: a worker with a request listens only to the answer.
 * -DDEAF: a stopped worker takes no messages.
 * -DHASTY: workers are stopped before the display has its last answers.
 *
 * Cells of one size are equal here: they are counted, not named. Messages on their way are counted
 * too, so that any may overtake any other. Limits are not sent: a worker may take any that are newer
 * than its own, as if it ignored older ones that come late. A report of an older phase would be ignored, so
 * none is kept. Reports arrive pixel by pixel: the sums of whole reports are among those made here.
 * Each check of a cell against the limits chooses its result anew. */
#define AREA (SINGLE + 2 * DOUBLE)
#define SIZES 3 /* of cells: 0, which only EMPTY makes, 1 and 2 pixels */
#define AT(w, s) (SIZES * (w) + (s))

/* The coordinator and the display. Phases are counted from 1. */
byte begun;
bool limited[PHASES + 1]; /* whether a phase has limits; the last one has none */
byte reported;            /* pixels in reports of the latest phase on their way */
byte sum;                 /* pixels in reports that have arrived */
bool over;                /* message to the display: the last phase is over */
bool ended;               /* the display's answer to `over` */
bool stop;                /* message to the workers, after this answer */

/* The workers. */
byte entered[W];      /* phase of the worker; 0: no limits have come yet */
byte returned[W];     /* pixels not yet reported */
byte finished[W];     /* pixels in finished cells */
byte open[SIZES * W]; /* active cells */
byte parked[SIZES * W];
byte moving[SIZES * W]; /* active cells on their way to each worker */
byte stopped;           /* number of stopped workers */
#ifdef PARKED_MOVE
bool parked_moved;
#endif

/* State of a worker's request: 1 + the processor it is on its way to, or one of these. */
#define NOTHING 0
#define UNHEARD (W + 1) /* the request reached a stopped worker */
#define REFUSAL (W + 2)
#define TASK(s) (W + 3 + (s)) /* the answer contains a cell of s pixels */
byte request[W];

/* The display's poll of a worker. */
#define ASKED 1
#define ANSWER 2
byte poll[W];

#define LIMITED(w) (entered[w] > 0 && limited[entered[w]])
#if W > 2
#define ANY(f) (f(0) || f(1) || f(2))
#else
#define ANY(f) (f(0) || f(1))
#endif
#define HAS(store, w) (store[AT(w, 0)] + store[AT(w, 1)] + store[AT(w, 2)] > 0)

/* Takes one cell, of any size, out of a store that has one. */
#define TAKE(store) \
  if \
  :: store[AT(w, 0)] > 0 -> s = 0 \
  :: store[AT(w, 1)] > 0 -> s = 1 \
  :: store[AT(w, 2)] > 0 -> s = 2 \
  fi; \
  store[AT(w, s)]--

inline park(s) {
  parked[AT(w, s)]++;
  returned[w] = returned[w] + s
}

inline classify(s) {
  if
  :: open[AT(w, s)]++
  :: LIMITED(w) -> park(s)
  fi
}

inline classify_again(s) {
  open[AT(w, s)] = open[AT(w, s)] + parked[AT(w, s)];
  parked[AT(w, s)] = 0;
  do
  :: LIMITED(w) && open[AT(w, s)] > 0 -> open[AT(w, s)]--; parked[AT(w, s)]++
  :: break
  od
}

inline enter() {
  entered[w]++;
  do
  :: entered[w] < begun -> entered[w]++
  :: break
  od;
  classify_again(1);
  classify_again(2);
#ifndef NO_RECOUNT
  returned[w] = finished[w] + parked[AT(w, 1)] + 2 * parked[AT(w, 2)]
#endif
}

/* A microtask: afterwards the cell is finished, beyond a limit, or divided. */
inline work(s) {
  if
  :: finished[w] = finished[w] + s; returned[w] = returned[w] + s
  :: LIMITED(w) -> park(s)
  :: s == 2 -> open[AT(w, 1)] = open[AT(w, 1)] + 2
#ifdef EMPTY
  :: s == 2 -> open[AT(w, 1)] = open[AT(w, 1)] + 2; open[AT(w, 0)]++
#endif
  fi
}

inline report() {
#ifdef NO_NUMBERS
  reported = reported + returned[w];
#else
  if
  :: entered[w] == begun -> reported = reported + returned[w]
  :: else
  fi;
#endif
  returned[w] = 0
}

/* Any other worker: the next one, or one after it. */
inline choose_other(v) {
  v = (w + 1) % W;
  do
  :: (v + 1) % W != w -> v = (v + 1) % W
  :: break
  od
}

inline answer(v) {
  if
  :: request[v] = REFUSAL
  :: HAS(open, w) -> TAKE(open); request[v] = TASK(s)
  fi
}

#ifdef PATIENT
#define LISTENS (request[w] == NOTHING)
#else
#define LISTENS true
#endif

proctype worker(byte w) {
  byte s, v;
  do
  :: atomic { LISTENS && entered[w] < begun -> enter() }
  :: atomic { LISTENS && HAS(moving, w) -> TAKE(moving); classify(s); s = 0 }
  :: atomic { LISTENS && entered[w] > 0 && HAS(open, w) -> TAKE(open); work(s); s = 0 }
  :: atomic { LISTENS && returned[w] > 0 -> report() }
  :: atomic { LISTENS && poll[w] == ASKED -> poll[w] = ANSWER }
#ifdef REQUESTS
  :: atomic {
       entered[w] > 0 && !HAS(open, w) && returned[w] == 0 && request[w] == NOTHING ->
       choose_other(v);
       request[w] = v + 1;
       v = 0
     };
progress_asked: skip
  :: atomic { LISTENS && request[(w + 1) % W] == w + 1 -> answer((w + 1) % W); s = 0 }
  :: atomic { LISTENS && request[(w + 2) % W] == w + 1 -> answer((w + 2) % W); s = 0 }
  :: atomic { request[w] == REFUSAL -> request[w] = NOTHING }
  :: atomic {
       request[w] > REFUSAL -> s = request[w] - TASK(0); classify(s); request[w] = NOTHING; s = 0
     }
#else
  :: atomic {
       HAS(open, w) ->
       TAKE(open);
       choose_other(v);
       moving[AT(v, s)]++;
#ifdef SENT_RETURNS
       returned[w] = returned[w] + s;
#endif
       s = 0;
       v = 0
     };
progress_sent: skip
#ifdef PARKED_MOVE
  :: atomic {
       !parked_moved && HAS(parked, w) ->
       parked_moved = true;
       TAKE(parked);
       choose_other(v);
       moving[AT(v, s)]++;
       s = 0;
       v = 0
     }
#endif
#endif
  :: atomic { LISTENS && stop -> stopped++; break }
  od;
end:
#ifndef DEAF
  do /* messages are taken without effect */
  :: atomic { request[w] == REFUSAL -> request[w] = NOTHING }
  :: atomic { request[(w + 1) % W] == w + 1 -> request[(w + 1) % W] = UNHEARD }
  :: atomic { request[(w + 2) % W] == w + 1 -> request[(w + 2) % W] = UNHEARD }
  :: atomic { poll[w] == ASKED -> poll[w] = 0 }
  od
#endif
}

/* Whether the state of w contradicts the end of the phase. */
#define UNDONE(w) \
  (HAS(open, w) || HAS(moving, w) || request[w] > REFUSAL || \
   (entered[w] != begun && (finished[w] > 0 || HAS(parked, w))))
#define ON_WAY(w) ((request[w] != NOTHING && request[w] != UNHEARD) || poll[w] != 0)

inline begin_phase() {
  begun++;
  sum = 0;
#ifndef NO_NUMBERS
  reported = 0;
#endif
  if
  :: begun < PHASES -> limited[begun] = true
  :: true
  fi
}

proctype coordinator() {
  do
  :: atomic { begun < PHASES -> begin_phase() } /* the first phase, or a later one by an order */
  :: atomic {
       reported > 0 ->
       reported--;
       sum++;
       if
       :: sum < AREA
       :: else ->
          assert(!ANY(UNDONE));
          if
          :: limited[begun] -> begin_phase()
          :: else -> over = true; break
          fi
       fi
     }
  od;
#ifndef HASTY
  ended;
#endif
  stop = true
}

/* The display's last look at each worker, after the last phase. */
proctype display() {
  byte w, shown;
  over;
  do
  :: w < W ->
     poll[w] = ASKED;
     atomic { poll[w] == ANSWER -> poll[w] = 0; shown = shown + finished[w]; w++ }
  :: else -> break
  od;
  assert(shown == AREA);
  ended = true
}

init {
  byte w, cells;
  atomic {
    do /* cells go to arbitrary workers */
    :: cells < SINGLE + DOUBLE ->
       if
       :: w = 0
       :: w = 1
#if W > 2
       :: w = 2
#endif
       fi;
       if
       :: cells < SINGLE -> moving[AT(w, 1)]++
       :: else -> moving[AT(w, 2)]++
       fi;
       cells++
    :: else -> break
    od;
    w = 0;
    cells = 0;
    do
    :: w < W -> run worker(w); w++
    :: else -> break
    od;
    w = 0;
    run coordinator();
    run display()
  }
  /* A run ends only here: no process may wait, and no message may be on its way. */
  ended && stopped == W && !ANY(ON_WAY)
}
