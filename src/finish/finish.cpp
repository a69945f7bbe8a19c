#include "finish/finish.h"
