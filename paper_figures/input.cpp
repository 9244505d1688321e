#include "paper_figures/input.h"

#include <cmath>
#include <functional>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization::figures {
namespace {

/// Parses, and refuses repeated keys, which the parser would let pass.
Json parse(const std::string& text, const std::string& name) {
  std::vector<std::set<std::string>> open;
  const Json::parser_callback_t watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      throw InputError(name + ": the entry '" + value.get<std::string>() + "' stands twice in one object");
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const Json::parse_error& error) {
    throw InputError(name + ", byte " + std::to_string(error.byte) + ": expected a JSON text");
  } catch (const Json::out_of_range&) {
    throw InputError(name + ": expected numbers that fit into double precision");
  }
}

}  // namespace

Fields::Fields(std::shared_ptr<Document> document, std::string pointer, const Json& here)
    : document_(std::move(document)), pointer_(std::move(pointer)), here_(&here) {}

Fields Fields::of_file(const std::filesystem::path& path) {
  auto document = std::make_shared<Document>();
  document->name = path.string();
  document->json = parse(read_file(path), document->name);
  const Json& root = document->json;
  if (!root.is_object()) throw InputError(document->name + ": expected an object");
  return {std::move(document), "", root};
}

bool Fields::has(const std::string& key) const {
  return here_->contains(key);
}

void Fields::refuse(const std::string& key, const std::string& expected) const {
  throw InputError(document_->name + ": " + pointer_ + "/" + key + ": expected " + expected);
}

const Json& Fields::entry(const std::string& key) const {
  document_->read.insert(pointer_ + "/" + key);
  const auto found = here_->find(key);
  if (found == here_->end()) refuse(key, "such an entry, found none");
  return *found;
}

std::string Fields::text(const std::string& key) const {
  const Json& value = entry(key);
  if (!value.is_string() || value.get<std::string>().empty()) refuse(key, "a text");
  return value.get<std::string>();
}

std::vector<std::string> Fields::texts(const std::string& key) const {
  const Json& list = entry(key);
  std::vector<std::string> result;
  if (list.is_array())
    for (const Json& value : list) {
      if (!value.is_string()) refuse(key, "texts only");
      result.push_back(value.get<std::string>());
    }
  if (result.empty()) refuse(key, "a list of one or more texts");
  return result;
}

double Fields::number_at(const Json& value, const std::string& key) const {
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(key, "a finite number");
  return value.get<double>();
}

double Fields::number(const std::string& key) const {
  return number_at(entry(key), key);
}

std::vector<double> Fields::numbers(const std::string& key) const {
  const Json& list = entry(key);
  std::vector<double> result;
  if (list.is_array())
    for (const Json& value : list) result.push_back(number_at(value, key));
  if (result.empty()) refuse(key, "a list of one or more numbers");
  return result;
}

int Fields::whole(const std::string& key, int least, int most) const {
  const Json& value = entry(key);
  if (!value.is_number_integer() || value < least || value > most)
    refuse(key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return value.get<int>();
}

Eigen::Vector3d Fields::vector(const std::string& key) const {
  const std::vector<double> values = numbers(key);
  if (values.size() != 3) refuse(key, "three numbers");
  return {values[0], values[1], values[2]};
}

Fields Fields::child(const Json& value, const std::string& pointer) const {
  if (!value.is_object()) throw InputError(document_->name + ": " + pointer + ": expected an object");
  document_->read.insert(pointer);
  return {document_, pointer, value};
}

Fields Fields::object(const std::string& key) const {
  return child(entry(key), pointer_ + "/" + key);
}

std::vector<Fields> Fields::objects(const std::string& key) const {
  const Json& list = entry(key);
  std::vector<Fields> result;
  if (list.is_array())
    for (const Json& value : list)
      result.push_back(child(value, pointer_ + "/" + key + "/" + std::to_string(result.size())));
  if (result.empty()) refuse(key, "a list of one or more objects");
  return result;
}

void Fields::refuse_unread() const {
  const std::function<void(const Json&, const std::string&)> visit = [&](const Json& value,
                                                                         const std::string& pointer) {
    if (value.is_object())
      for (const auto& [key, entry] : value.items()) {
        const std::string place = pointer + "/" + key;
        if (!document_->read.contains(place))
          throw InputError(document_->name + ": " + place + ": this entry is not known");
        visit(entry, place);
      }
    if (value.is_array())
      for (std::size_t k = 0; k < value.size(); ++k) visit(value[k], pointer + "/" + std::to_string(k));
  };
  visit(document_->json, "");
}

Camera read_camera(const Fields& fields) {
  const Fields camera = fields.object("camera");
  return {camera.number("azimuth"), camera.number("elevation")};
}

int read_copies(const Fields& fields, int least) {
  constexpr int max_copies = 20;
  return fields.whole("copies", least, max_copies);
}

ModelSource read_model_source(const Fields& fields) {
  ModelSource source;
  source.file = fields.text("file");
  if (fields.has("labels")) source.labels = fields.text("labels");
  if (fields.has("up")) {
    const std::string up = fields.text("up");
    if (up != "x" && up != "y" && up != "z") fields.refuse("up", "x, y or z");
    source.up = up.front();
  }
  if (fields.has("unit")) {
    for (const Unit unit : {Unit::millimetre, Unit::centimetre, Unit::metre})
      if (unit_symbol(unit) == fields.text("unit")) source.unit = unit;
    if (source.unit == Unit::unknown) fields.refuse("unit", "mm, cm or m");
  }
  return source;
}

Shape ModelFolder::read(const ModelSource& source) const {
  ReadOptions options;
  if (source.labels) options.labels = path / *source.labels;
  options.up = source.up == 'x' ? Axis::x : source.up == 'y' ? Axis::y : Axis::z;
  if (source.unit != Unit::unknown) options.unit = source.unit;
  return read_shape(path / source.file, options);
}

}  // namespace stackabilization::figures
