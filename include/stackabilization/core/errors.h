#pragma once

#include <stdexcept>
#include <string>

namespace stackabilization {

/// Base of all errors that this library throws. `what()` is one sentence in the user's words.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input file or shape cannot be used. The message names the file, the place and the expected content.
/// Programs exit with status 3.
class InputError : public Error {
 public:
  using Error::Error;
};

/// An option or argument violates its documented precondition. Programs exit with status 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A result cannot be written to the requested place. Programs exit with status 2.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// Pictures and depth images cannot be rendered: there is no OpenGL context, or the driver failed. Programs
/// exit with status 3.
class RenderError : public Error {
 public:
  using Error::Error;
};

}  // namespace stackabilization
