#include "stackabilization/improvement/removal.h"
