/* Debian ships volk as source: this compiles it once. */
#include <volk.c>
