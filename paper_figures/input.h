#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

/// What the figures are told to do: one JSON file for each, read strictly.
namespace stackabilization::figures {

using Json = nlohmann::ordered_json;

/// The entries of one object of an input file. Everything that is asked for must be there, of the right type
/// and in range, and `refuse_unread` finds what nobody asked for. All functions throw InputError with the
/// file, the place as a JSON pointer and what was expected there.
class Fields {
 public:
  /// Reads a file. Repeated keys are refused.
  static Fields of_file(const std::filesystem::path& path);

  bool has(const std::string& key) const;
  std::string text(const std::string& key) const;
  std::vector<std::string> texts(const std::string& key) const;  ///< one or more
  double number(const std::string& key) const;                   ///< finite
  std::vector<double> numbers(const std::string& key) const;     ///< one or more
  int whole(const std::string& key, int least, int most) const;
  Eigen::Vector3d vector(const std::string& key) const;  ///< three finite numbers
  Fields object(const std::string& key) const;
  std::vector<Fields> objects(const std::string& key) const;  ///< one or more

  /// What is wrong with an entry, as an error to be thrown.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;
  /// Refuses entries of the whole file that nobody has asked for.
  void refuse_unread() const;

 private:
  struct Document {
    Json json;
    std::string name;
    std::set<std::string> read;  ///< JSON pointers
  };

  Fields(std::shared_ptr<Document> document, std::string pointer, const Json& here);
  const Json& entry(const std::string& key) const;
  double number_at(const Json& value, const std::string& key) const;
  Fields child(const Json& value, const std::string& pointer) const;

  std::shared_ptr<Document> document_;
  std::string pointer_;
  const Json* here_;
};

/// From where a scene is seen: see ViewOptions.
struct Camera {
  double azimuth = 35, elevation = 25;  ///< degrees
};

/// Entry "camera": {"azimuth": 35, "elevation": 25}.
Camera read_camera(const Fields& fields);

/// Entry "copies": in a stack, from `least` to 20.
int read_copies(const Fields& fields, int least = 1);

/// A mesh file in the folder of models.
struct ModelSource {
  std::string file;                   ///< path in the folder
  std::optional<std::string> labels;  ///< part labels, path in the folder
  char up = 'z';                      ///< axis of the file that points up: x, y or z
  Unit unit = Unit::unknown;
};

/// {"file": "chair.obj", "unit": "m", "up": "y", "labels": "chair.seg"}; all but the file may be missing.
ModelSource read_model_source(const Fields& fields);

/// The folder that model files are looked for in.
struct ModelFolder {
  std::filesystem::path path;

  /// Throws InputError naming the file.
  Shape read(const ModelSource& source) const;
};

}  // namespace stackabilization::figures
