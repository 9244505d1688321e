#pragma once

#include <CLI/Error.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/failure_sentence.h"

/// How programs end, here and in paper_figures/.
namespace stackabilization::apps {

enum ExitStatus {
  status_done = 0,
  status_no = 1,     ///< it ran, but the answer is no: validation failed, a wish is not met
  status_usage = 2,  ///< wrong usage, or an output that cannot be written
  status_input = 3,  ///< unreadable or unusable input
};

/// Prints one sentence on standard error, after the name of the program. Returns the status.
inline int complain(const std::string& program, std::string sentence, int status) {
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  std::cerr << program << ": " << sentence << '\n';
  return status;
}

/// Says what the exception that is being handled means for a person. Returns the exit status.
inline int complain_of_exception(const std::string& program) {
  try {
    throw;
  } catch (const CLI::Error& error) {
    return complain(program, error.what(), status_usage);
  } catch (const UsageError& error) {
    return complain(program, error.what(), status_usage);
  } catch (const OutputError& error) {
    return complain(program, error.what(), status_usage);
  } catch (const std::exception& error) {
    return complain(program, failure_sentence(error), status_input);
  }
}

}  // namespace stackabilization::apps
