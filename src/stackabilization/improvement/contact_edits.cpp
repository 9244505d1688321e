#include "stackabilization/improvement/contact_edits.h"
