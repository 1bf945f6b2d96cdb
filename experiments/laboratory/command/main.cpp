#include "experiments/laboratory/command/commands.hpp"

int main(int argc, char** argv) { return laboratory::run_tlab(argc, argv); }
