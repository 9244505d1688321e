#pragma once

#include <string>

namespace stackabilization::apps {

/// "0.1.0"
std::string version_number();

/// Version and revision, and in a second line what the program was built with.
std::string version_text();

}  // namespace stackabilization::apps
