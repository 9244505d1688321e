#include "stackabilization/improvement/best_first.h"
