// SPDX-License-Identifier: Apache-2.0
#include "scene_check.hpp"
#include "scene_json.hpp"

#include <stoss/idl/scene_file.hpp>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>
#include <google/protobuf/unknown_field_set.h>
#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unordered_map>
#include <vector>

namespace stoss::idl {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using google::protobuf::TextFormat;

SceneError error_of(const std::string& file, Code code, std::string reason) {
  SceneError error;
  error.code = code;
  error.file = file;
  error.reason = std::move(reason);
  return error;
}

// Line and column of an offset, from 1; the column counts bytes.
void place(std::string_view text, std::size_t offset, SceneError& error) {
  const std::string_view before = text.substr(0, offset);
  error.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_begin = before.rfind('\n');
  error.column = 1 + (line_begin == before.npos ? offset : offset - line_begin - 1);
}

std::optional<SceneError> read_json_scene(std::string_view content,
                                          const std::string& file,
                                          Scene& scene) {
  const std::optional<JsonError> fault = read_json(content, scene);
  if (!fault) return std::nullopt;
  SceneError error = error_of(file, Code::kInvalidArgument, fault->reason);
  error.field = fault->place.field;
  place(content, fault->place.offset, error);
  name_body(scene, error);
  return error;
}

// Keeps the first error of the text format's parser, which counts lines and columns from 0.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int at_line, int at_column, const std::string& message) override {
    if (found) return;
    found = true;
    reason = message;
    line = at_line < 0 ? 0 : static_cast<std::size_t>(at_line) + 1;
    column = at_column < 0 ? 0 : static_cast<std::size_t>(at_column) + 1;
  }
  bool found = false;
  std::size_t line = 0;
  std::size_t column = 0;
  std::string reason;
};

std::optional<SceneError> read_text(std::string_view content,
                                    const std::string& file,
                                    Scene& scene) {
  FirstError first;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&first);
  if (parser.ParseFromString(std::string(content), &scene)) return std::nullopt;
  SceneError error = error_of(file, Code::kInvalidArgument, first.reason);
  error.line = first.line;
  error.column = first.column;
  return error;
}

// Are all fields of all disks known? Without asking each which fields it has, for it is asked a
// million times.
bool are_known(const google::protobuf::RepeatedPtrField<Disk>& disks) {
  const Reflection& of_disk = *Disk::GetReflection();
  const Reflection& of_vector = *Vector2::GetReflection();
  return std::all_of(disks.begin(), disks.end(), [&](const Disk& disk) {
    return of_disk.GetUnknownFields(disk).empty() &&
           of_vector.GetUnknownFields(disk.position()).empty() &&
           of_vector.GetUnknownFields(disk.velocity()).empty();
  });
}
/// What are_known() looks into.
constexpr std::size_t kMessagesOfDisk = 2;

// Looks for fields that a message's type does not have. Of each type it knows which fields hold
// messages: to ask a million disks for all fields that they have would take longer than reading
// them. It would even to ask them for those, so they are looked through before.
class UnknownFields {
 public:
  // The path of the first one in `message`, or nothing.
  std::optional<std::string> find_in(const Message& message) {
    const Reflection& reflection = *message.GetReflection();
    const google::protobuf::UnknownFieldSet& unknown = reflection.GetUnknownFields(message);
    if (!unknown.empty()) return "field number " + std::to_string(unknown.field(0).number());
    for (const FieldDescriptor* field : message_fields(message)) {
      if (field->message_type() == Disk::descriptor() && has_known_disks(message)) continue;
      if (field->is_repeated()) {
        for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
          const auto found = find_in(reflection.GetRepeatedMessage(message, field, i));
          if (found) return field->name() + '[' + std::to_string(i) + "]." + *found;
        }
      } else if (reflection.HasField(message, field)) {
        const auto found = find_in(reflection.GetMessage(message, field));
        if (found) return field->name() + '.' + *found;
      }
    }
    return std::nullopt;
  }

 private:
  using Fields = std::vector<const FieldDescriptor*>;

  const Fields& message_fields(const Message& message) {
    const google::protobuf::Descriptor* const type = message.GetDescriptor();
    const auto [entry, is_new] = fields_of_.try_emplace(type);
    if (is_new) {
      for (int i = 0; i < type->field_count(); ++i) {
        const FieldDescriptor* const field = type->field(i);
        if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) entry->second.push_back(field);
      }
    }
    return entry->second;
  }

  // A "no" says nothing.
  bool has_known_disks(const Message& message) {
    const auto* const scene = dynamic_cast<const Scene*>(&message);
    return scene != nullptr && message_fields(Disk::default_instance()).size() == kMessagesOfDisk &&
           are_known(scene->disks());
  }

  std::unordered_map<const google::protobuf::Descriptor*, Fields> fields_of_;
};

std::optional<SceneError> read_binary(std::string_view content,
                                      const std::string& file,
                                      Scene& scene) {
  if (!scene.ParseFromArray(content.data(), static_cast<int>(content.size()))) {
    return error_of(
        file, Code::kInvalidArgument, "is not a stoss.Scene in Protobuf's binary format");
  }
  const std::optional<std::string> unknown = UnknownFields().find_in(scene);
  if (!unknown) return std::nullopt;
  SceneError error = error_of(file, Code::kInvalidArgument, "is not known to this version");
  error.field = *unknown;
  name_body(scene, error);
  return error;
}

// The place of a field in a text-format scene, through the tree that the parser keeps of places.
void locate_text(std::string_view content, SceneError& error) {
  TextFormat::ParseInfoTree places;
  TextFormat::Parser parser;
  parser.WriteLocationsTo(&places);
  Scene scratch;
  if (!parser.ParseFromString(std::string(content), &scratch)) return;
  const google::protobuf::Descriptor* type = Scene::descriptor();
  const TextFormat::ParseInfoTree* tree = &places;
  std::istringstream steps(error.field);
  for (std::string step; type != nullptr && tree != nullptr && std::getline(steps, step, '.');) {
    const std::size_t open = step.find('[');
    const FieldDescriptor* field = type->FindFieldByName(step.substr(0, open));
    if (field == nullptr) return;
    const int index = open == step.npos ? -1 : std::stoi(step.substr(open + 1));
    const TextFormat::ParseLocation at = tree->GetLocation(field, index);
    if (at.line < 0) return;
    error.line = static_cast<std::size_t>(at.line) + 1;
    error.column = static_cast<std::size_t>(at.column) + 1;
    tree = field->message_type() == nullptr ? nullptr : tree->GetTreeForNested(field, index);
    type = field->message_type();
  }
}

std::string system_reason(const char* what, int code) {
  return std::string(what) + ": " + std::strerror(code);
}

std::variant<std::string, SceneError> content_of(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    return error_of(path.string(), Code::kInvalidArgument, "is a directory");
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const int code = errno;
    return error_of(path.string(),
                    code == ENOENT ? Code::kNotFound : Code::kUnavailable,
                    system_reason("cannot be opened", code));
  }
  // Of a regular file all at once, and one byte more, which tells that there is no more.
  const std::uintmax_t known = std::filesystem::file_size(path, none);
  constexpr std::size_t kPiece = 1 << 16;
  std::string content(none ? kPiece : std::max<std::size_t>(known + 1, kPiece), '\0');
  std::size_t size = 0;
  while (in) {
    if (size == content.size()) content.resize(2 * size);
    in.read(&content[size], static_cast<std::streamsize>(content.size() - size));
    size += static_cast<std::size_t>(in.gcount());
  }
  if (in.bad()) {
    return error_of(path.string(), Code::kUnavailable, system_reason("cannot be read", errno));
  }
  content.resize(size);
  return content;
}

SceneError unknown_format(const std::filesystem::path& path) {
  return error_of(
      path.string(), Code::kInvalidArgument, "its extension must be .json, .textproto or .binpb");
}

std::string encode(const Scene& scene, SceneFormat format) {
  std::string out;
  switch (format) {
    case SceneFormat::kJson: {
      google::protobuf::util::JsonPrintOptions options;
      options.add_whitespace = true;
      options.preserve_proto_field_names = true;
      static_cast<void>(google::protobuf::util::MessageToJsonString(scene, &out, options));
      break;
    }
    case SceneFormat::kText:
      TextFormat::PrintToString(scene, &out);
      break;
    case SceneFormat::kBinary:
      scene.SerializeToString(&out);
      break;
  }
  return out;
}

}  // namespace

std::string SceneError::message() const {
  std::string out = file;
  if (line > 0) out += ':' + std::to_string(line) + ':' + std::to_string(column);
  if (!out.empty()) out += ": ";
  if (!field.empty()) out += field;
  if (id != 0 || !body.empty()) {
    out += " (";
    if (id != 0) out += "id " + std::to_string(id);
    if (!body.empty()) out += (id != 0 ? ", \"" : "\"") + body + '"';
    out += ')';
  }
  if (!field.empty()) out += ": ";
  return out + reason;
}

std::optional<SceneFormat> scene_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".json") return SceneFormat::kJson;
  if (extension == ".textproto") return SceneFormat::kText;
  if (extension == ".binpb") return SceneFormat::kBinary;
  return std::nullopt;
}

std::variant<Scene, SceneError> parse_scene(std::string_view content,
                                            SceneFormat format,
                                            const std::string& file) {
  Scene scene;
  std::optional<SceneError> error;
  switch (format) {
    case SceneFormat::kJson:
      error = read_json_scene(content, file, scene);
      break;
    case SceneFormat::kText:
      error = read_text(content, file, scene);
      break;
    case SceneFormat::kBinary:
      error = read_binary(content, file, scene);
      break;
  }
  if (error) return *std::move(error);
  error = check_scene(scene);
  if (!error) return scene;
  error->file = file;
  // The text is read once more only now, so that good scenes pay nothing for the places of faults.
  if (format == SceneFormat::kJson) {
    place(content, locate_json(content, scene, error->field), *error);
  } else if (format == SceneFormat::kText) {
    locate_text(content, *error);
  }
  return *std::move(error);
}

std::variant<Scene, SceneError> load_scene(const std::filesystem::path& path) {
  const std::optional<SceneFormat> format = scene_format(path);
  if (!format) return unknown_format(path);
  std::variant<std::string, SceneError> content = content_of(path);
  if (auto* error = std::get_if<SceneError>(&content)) return std::move(*error);
  return parse_scene(std::get<std::string>(content), *format, path.string());
}

std::optional<SceneError> save_scene(const Scene& scene, const std::filesystem::path& path) {
  const std::optional<SceneFormat> format = scene_format(path);
  if (!format) return unknown_format(path);
  const std::string content = encode(scene, *format);
  // Beside the target, so that the renaming is atomic and a full disk leaves the old file whole.
  const std::filesystem::path fresh = path.string() + '.' + std::to_string(getpid());
  errno = 0;
  std::ofstream out(fresh, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  const int write_code = errno;
  std::error_code none;
  if (!out) {
    std::filesystem::remove(fresh, none);
    return error_of(
        path.string(), Code::kUnavailable, system_reason("cannot be written", write_code));
  }
  std::error_code renamed;
  std::filesystem::rename(fresh, path, renamed);
  if (!renamed) return std::nullopt;
  std::filesystem::remove(fresh, none);
  return error_of(path.string(), Code::kUnavailable, "cannot be replaced: " + renamed.message());
}

}  // namespace stoss::idl
