#include "stackabilization/improvement/requirements.h"
