#include "stackabilization/stacking/standing.h"
