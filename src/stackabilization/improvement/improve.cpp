#include "stackabilization/improvement/improve.h"
