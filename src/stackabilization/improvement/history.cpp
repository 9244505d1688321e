#include "stackabilization/improvement/history.h"
