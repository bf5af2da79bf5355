/* record.cl for the paths of path_full.cl. */
#define TRIAD_HERO 1

#include "shading/record.cl"
