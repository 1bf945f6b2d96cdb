#include "experiments/commands.hpp"

int main(int argc, char** argv) { return experiments::run_tlab(argc, argv); }
