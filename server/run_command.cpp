#include "server/run_command.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>

#include "core/error.h"
#include "proto/execute.h"
#include "proto/picture.h"
#include "server/problem.h"

namespace wellspaced {
namespace {

constexpr int failed = 1, no_file = 2, wrong_command = 2;

bool ends_with(const std::string& path, std::string_view ending) { return path.ends_with(ending); }

std::string content_type_of(const Invocation& i) {
  if (!i.content_type.empty()) return i.content_type;
  if (ends_with(i.request_path, ".npy")) return std::string(media_type_of(Format::npy));
  if (ends_with(i.request_path, ".csv")) return std::string(media_type_of(Format::csv));
  return std::string(media_type_of(Format::json));
}

/// The one asked for, else by the output's ending, else the default; nothing if there is no such format.
std::optional<Format> output_format(const Invocation& i) {
  std::string name = i.format;
  if (name.empty() && i.output_path != "-") name = std::filesystem::path(i.output_path).extension().string();
  if (name.starts_with('.')) name.erase(0, 1);
  const auto formats = formats_of(i.operation);
  return name.empty() ? formats.front() : format_named(name, formats);
}

std::string no_such_format(const Invocation& i) {
  std::string list;
  for (const Format format : formats_of(i.operation))
    list += (list.empty() ? "" : ", ") + std::string(name_of(format));
  return (i.format.empty() ? "-o: the ending of '" + i.output_path + "' is none of " + list +
                                 "; give the file one of these endings, or say --format"
                           : "--format: '" + i.format + "' is none of " + list);
}

std::vector<std::pair<std::string, std::string>> read_query(const Invocation& i) {
  std::vector<std::pair<std::string, std::string>> query;
  for (const std::string& text : i.query) {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
      throw Error(ErrorCode::invalid_parameters, "--query takes name=value, not '" + text + "'");
    query.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return query;
}

bool read_file(const std::string& path, std::string& bytes) {
  if (path == "-") {
    bytes.assign(std::istreambuf_iterator<char>(std::cin), {});
    return true;
  }
  if (std::filesystem::is_directory(path)) return false;  // which opens, but throws when read
  std::ifstream file(path, std::ios::binary);
  bytes.assign(std::istreambuf_iterator<char>(file), {});
  return file.is_open() && !file.bad();
}

bool write_file(const std::string& path, const std::string& bytes) {
  if (path == "-")
    return static_cast<bool>(
        std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush());
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return static_cast<bool>(file);
}

std::string encoded_result(const Invocation& i, Format format, const std::string& body) {
  auto query = read_query(i);
  if (!i.picture.empty()) query.emplace_back("picture", i.picture);
  const std::string content_type = content_type_of(i);
  References references;
  references.job_points = [](const std::string&) -> PointSet {
    throw Error(ErrorCode::no_such_job,
                "wellspaced run knows no jobs; save the job's points and give them as npy or csv");
  };
  references.domain = [](const std::string&) -> std::shared_ptr<const Domain> {
    throw Error(ErrorCode::no_such_domain, "wellspaced run knows no uploaded domains; give the domain whole");
  };
  const Request request =
      read_request(raw_request(i.operation, content_type, body, query), i.config.limits, references);
  Control control(i.config.threads);
  if (is_picture(format)) {
    PictureCall call = read_picture(request.picture, "/picture");
    call.format = format;
    require_drawable(request, call, i.config.limits);
  }
  return encode_result(execute(request, control), format, {}, i.config.limits, control).bytes;
}

}  // namespace

int run_command(const Invocation& i) {
  const std::optional<Format> format = output_format(i);
  if (!format) {
    std::cerr << "wellspaced: " << no_such_format(i) << "\n";
    return wrong_command;
  }
  std::string body;
  if (!read_file(i.request_path, body)) {
    std::cerr << "wellspaced: can't read " << i.request_path << "\n";
    return no_file;
  }
  std::string bytes;
  try {
    bytes = encoded_result(i, *format, body);
  } catch (const Error& error) {
    std::cerr << to_json(to_problem(error), "") << "\n";
    return failed;
  }
  if (write_file(i.output_path, bytes)) return 0;
  std::cerr << "wellspaced: can't write " << i.output_path << "\n";
  return no_file;
}

}  // namespace wellspaced
