#include "server/log.h"

#include <spdlog/async.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

/// `"message":"...","key":...` without braces: the pattern adds time and level.
std::string line(const std::string& message, const ordered_json& fields) {
  ordered_json object = {{"message", message}};
  object.update(fields);
  const std::string text = object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

}  // namespace

void start_log(const std::string& level) {
  spdlog::drop("wellspaced");
  // Asynchronous: the thread that waits for all connections logs, too, and must not wait for a reader of this log.
  auto logger = spdlog::create_async_nb<spdlog::sinks::stderr_sink_mt>("wellspaced");
  logger->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})", spdlog::pattern_time_type::utc);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_info(const std::string& message, ordered_json fields) { spdlog::info("{}", line(message, fields)); }
void log_error(const std::string& message, ordered_json fields) { spdlog::error("{}", line(message, fields)); }
void flush_log() { spdlog::shutdown(); }

}  // namespace wellspaced
