#include "stackabilization/improvement/energy.h"
