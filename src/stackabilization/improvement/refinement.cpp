#include "stackabilization/improvement/refinement.h"
