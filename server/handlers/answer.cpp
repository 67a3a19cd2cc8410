#include "server/handlers/answer.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <ctime>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/picture.h"
#include "proto/result.h"
#include "server/problem.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr int longest_wait_seconds = 60;

ordered_json optional_time(const std::optional<std::int64_t>& ms) {
  return ms ? ordered_json(timestamp(*ms)) : ordered_json();
}

ordered_json links(const Job& job) {
  const std::string self = "/v1/jobs/" + job.id;
  ordered_json out = ordered_json::array();
  out.push_back({{"rel", "self"}, {"href", self}});
  out.push_back({{"rel", "events"}, {"href", self + "/events"}});
  if (job.status == JobStatus::successful) out.push_back({{"rel", "result"}, {"href", self + "/result"}});
  return out;
}

void read_preferences(std::string_view text, Preference& preference) {
  while (!text.empty()) {
    const auto comma = text.find_first_of(",;");
    std::string_view item = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
    while (!item.empty() && item.back() == ' ') item.remove_suffix(1);
    std::string word(item);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (word == "respond-async") preference.respond_async = true;
    if (!word.starts_with("wait=")) continue;
    int seconds = -1;
    const auto end = std::from_chars(word.data() + 5, word.data() + word.size(), seconds);
    const bool too_big = end.ec == std::errc::result_out_of_range;
    if (too_big || (end.ec == std::errc() && seconds >= 0))
      preference.wait_seconds = too_big ? longest_wait_seconds : std::min(seconds, longest_wait_seconds);
  }
}

Encoded encode(Context& context, const Result& result, const Wanted& wanted) {
  const Limits& limits = context.config.limits;
  Control control(context.config.threads, &context.pictures);
  if (wanted.gone) control.watch(*wanted.gone);
  if (is_picture(wanted.format)) {
    // Estimates hold for ordinary point sets.
    const std::chrono::duration<double> most(2 * std::min(limits.picture_seconds, 1e6));
    control.set_deadline(Control::Clock::now() + std::chrono::duration_cast<Control::Clock::duration>(most),
                         "to draw this picture takes too long; ask for another, or for one of fewer points");
  }
  try {
    return encode_result(result, wanted.format, wanted.picture, limits, control);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::deadline_exceeded) throw error.within("/picture");
    if (error.code() != ErrorCode::cancelled || !context.draining) throw;
    throw Error(ErrorCode::draining, "the server is stopping; ask again in a moment");
  }
}

}  // namespace

std::string timestamp(std::int64_t ms) {
  const std::time_t seconds = ms / 1000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[40];
  const std::size_t n = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
  const std::string millis = std::to_string(1000 + ms % 1000).substr(1);
  return std::string(text, n) + "." + millis + "Z";
}

std::string owner_of(const http::Request&) { return ""; }

std::string query_value(const http::Request& request, const std::string& name) {
  for (const auto& [key, value] : request.query) {
    if (key != name) continue;
    if (value.empty())
      throw Error(ErrorCode::invalid_parameters, "it is empty; give a value or leave it out", "/" + name);
    return value;
  }
  return "";
}

Wanted read_wanted(const http::Request& request, const std::string& operation) {
  Wanted wanted;
  wanted.picture = picture_of_query(request.query);
  wanted.gone = request.gone;
  wanted.format = negotiate(query_value(request, "format"), request.header("Accept"), formats_of(operation));
  return wanted;
}

Preference read_preference(const http::Request& request) {
  Preference preference;
  const auto [from, to] = request.headers.equal_range("Prefer");
  for (auto header = from; header != to; ++header) read_preferences(header->second, preference);
  return preference;
}

http::Response json_response(std::string text, int status) {
  http::Response response;
  response.status = status;
  response.body = std::move(text);
  response.set("Content-Type", "application/json").set("Cache-Control", "no-store");
  return response;
}

std::string job_to_json(const Job& job) {
  ordered_json out = {{"id", job.id},
                      {"operation", job.operation},
                      {"status", to_string(job.status)},
                      {"progress", job.progress},
                      {"message", job.message},
                      {"attempt", job.attempt}};
  if (job.status == JobStatus::accepted) out["queue"] = {{"position", job.queue_position}};
  out["created"] = timestamp(job.created_ms);
  out["started"] = optional_time(job.started_ms);
  out["updated"] = timestamp(job.updated_ms);
  out["finished"] = optional_time(job.finished_ms);
  out["expires"] = optional_time(job.expires_ms);
  out["links"] = links(job);
  if (!job.problem.empty()) out["problem"] = ordered_json::parse(job.problem, nullptr, false);
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

http::Response result_response(Context& context, const Job& job, const Wanted& wanted,
                               const std::string& request_id) {
  if (job.status == JobStatus::failed) return to_response(problem_from_json(job.problem), request_id);
  if (job.status == JobStatus::dismissed)
    throw Error(ErrorCode::cancelled,
                "the job was cancelled before it had a result; submit the request again");
  const DomainById find_domain = [&](const std::string& id) { return context.domains.get(job.owner, id); };
  Encoded encoded = encode(context, load_result(context.store.result(job.id), find_domain), wanted);
  http::Response response;
  response.body = std::move(encoded.bytes);
  response.set("Content-Type", encoded.media_type)
      .set("Content-Disposition", "inline; filename=\"" + encoded.file_name + "\"")
      .set("Wellspaced-Job", job.id)
      .set("Link", "</v1/jobs/" + job.id + ">; rel=\"describedby\"");
  if (!encoded.summary_line.empty()) response.set("Wellspaced-Summary", encoded.summary_line);
  return response;
}

}  // namespace wellspaced
