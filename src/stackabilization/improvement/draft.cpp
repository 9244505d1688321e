#include "stackabilization/improvement/draft.h"
