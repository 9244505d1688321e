#include "stackabilization/stacking/stackability.h"
