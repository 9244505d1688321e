#include "stackabilization/improvement/diagnosis.h"
