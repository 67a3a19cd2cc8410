#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace wellspaced {

/// One JSON object a line on standard error: {"time", "level", "message", ...fields}, whatever is logged
/// through spdlog's default logger included. Before `start_log` nothing is written. Thread safety: any
/// thread. Invalid UTF-8 in fields is replaced.
void start_log(const std::string& level);
void log_info(const std::string& message, const nlohmann::ordered_json& fields = {});
void log_error(const std::string& message, const nlohmann::ordered_json& fields = {});

/// Writes out what is buffered and ends the log; for the end of the process.
void flush_log();

}  // namespace wellspaced
