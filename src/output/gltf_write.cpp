#include "output/gltf_write.h"
