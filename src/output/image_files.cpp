#include "output/image_files.h"
