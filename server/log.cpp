#include "server/log.h"

#include <memory>
#include <string_view>

#include <spdlog/async.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view members_logger = "wellspaced-members";

/// `"message":"...","key":...` without braces: the pattern adds time and level.
std::string line(const std::string& message, const ordered_json& fields) {
  ordered_json object = {{"message", message}};
  object.update(fields);
  const std::string text = object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

/// Lets the members of `line` through, and makes a member of what others say in plain words.
class Members final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string_view name(message.logger_name.data(), message.logger_name.size());
    std::string text(message.payload.data(), message.payload.size());
    if (name != members_logger) text = line(text, ordered_json::object());
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<Members>(); }
};

std::shared_ptr<spdlog::logger> make_logger(std::string_view name, const spdlog::sink_ptr& sink,
                                            const std::string& level) {
  // Asynchronous: the thread that waits for all connections logs, too, and must not wait for a reader of this
  // log.
  auto logger = std::make_shared<spdlog::async_logger>(std::string(name), sink, spdlog::thread_pool(),
                                                       spdlog::async_overflow_policy::overrun_oldest);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  return logger;
}

void write(spdlog::level::level_enum level, const std::string& message, const ordered_json& fields) {
  if (const auto logger = spdlog::get(std::string(members_logger)))
    logger->log(level, "{}", line(message, fields));
}

}  // namespace

void start_log(const std::string& level) {
  constexpr std::size_t lines_waiting = 8192;
  spdlog::init_thread_pool(lines_waiting, 1);
  auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  formatter->add_flag<Members>('*').set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%*})");
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_formatter(std::move(formatter));
  spdlog::drop(std::string(members_logger));
  spdlog::register_logger(make_logger(members_logger, sink, level));
  spdlog::set_default_logger(make_logger("wellspaced", sink, level));
}

void log_info(const std::string& message, const ordered_json& fields) {
  write(spdlog::level::info, message, fields);
}
void log_error(const std::string& message, const ordered_json& fields) {
  write(spdlog::level::err, message, fields);
}
void flush_log() { spdlog::shutdown(); }

}  // namespace wellspaced
