/* The same with four wavelengths per path instead of RGB: --spectral full. */
#define TRIAD_HERO 1

#include "path/wave_stages.cl"
