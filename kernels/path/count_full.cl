/* count.cl for the paths of mega_full.cl. */
#define TRIAD_HERO 1

#include "path/count.cl"
