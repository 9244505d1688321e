#include "stackabilization/improvement/thickness.h"
