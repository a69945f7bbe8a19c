#include "rays/ray_scene.h"
