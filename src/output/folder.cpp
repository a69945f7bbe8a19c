#include "output/folder.h"
