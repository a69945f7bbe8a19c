#include "reference/metrics.h"
