#include "stackabilization/improvement/shape_change.h"
