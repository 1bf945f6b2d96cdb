/* Chalmers's router (figure 5.11): it stores all messages that arrive during a send.
 * -DBUFFER=capacity in messages, beside the one being sent. */
#include "network.pml"

chan buffer[N] = [BUFFER] of { byte };
chan into_sender[N] = [0] of { byte };
chan to_handle_input[N] = [0] of { bit };

#define ANY_INPUT(d) \
  if \
  :: wire[IN(p, 0)]?d \
  :: wire[IN(p, 1)]?d \
  :: from_client[p]?d \
  fi

/* The sending half of the PRI PAR. */
proctype sending(byte p) {
  byte d;
end:
  do
  :: into_sender[p]?d ->
     if
     :: d == p -> to_client[p]!d
     :: else -> wire[2 * p + LINK(p, d)]!d
     fi;
     d = 0;
     to_handle_input[p]!0
  od
}

proctype router(byte p) {
  byte d;
end:
  ANY_INPUT(d);
send:
  into_sender[p]!d;
  d = 0;
  do
  :: atomic {
       ANY_INPUT(d);
       if
       :: nfull(buffer[p]) -> buffer[p]!d; d = 0
       :: full(buffer[p]) -> goto overflow
       fi
     }
  :: atomic {
       to_handle_input[p]?_ ->
       if
       :: nempty(buffer[p]) -> buffer[p]?d; goto send
       :: empty(buffer[p]) -> goto end
       fi
     }
  od;
  OVERFLOW
}

init {
  byte p;
  atomic {
    do
    :: p < N -> run router(p); run sending(p); START_CLIENT(p); p++
    :: else -> break
    od
  }
}
