#pragma once

#include <string>

namespace stackabilization {

/// What the Error says that `work` throws, "accepted" when it throws none.
template <class Error, class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// Do these words stand in the text?
inline bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace stackabilization
