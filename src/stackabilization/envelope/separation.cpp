#include "stackabilization/envelope/separation.h"
