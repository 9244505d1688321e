#pragma once

#include <string>

namespace stackabilization::apps {

class Program;

/// A script for bash that completes commands, their options and the values that have names.
std::string completion_script(const Program& program);

}  // namespace stackabilization::apps
