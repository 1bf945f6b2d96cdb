/* The naive router: takes a message from any input, then outputs it, and does nothing else meanwhile. */
#include "network.pml"

proctype router(byte p) {
  byte d;
end:
  do
  :: if
     :: wire[IN(p, 0)]?d
     :: wire[IN(p, 1)]?d
     :: from_client[p]?d
     fi;
     if
     :: d == p -> to_client[p]!d
     :: else -> wire[2 * p + LINK(p, d)]!d
     fi;
     d = 0
  od
}

init {
  byte p;
  atomic {
    do
    :: p < N -> run router(p); START_CLIENT(p); p++
    :: else -> break
    od
  }
}
