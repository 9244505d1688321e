#include "stackabilization/improvement/design.h"
