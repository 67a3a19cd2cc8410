#include "server/metrics.h"

#include <array>
#include <charconv>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

#include "proto/result.h"

namespace wellspaced {
namespace {

constexpr std::array<double, 12> bucket_seconds = {0.001, 0.005, 0.01, 0.05, 0.1, 0.25,
                                                   0.5,   1,     2.5,  10,   60,  600};

std::string label(const char* name, const std::string& value) {
  std::string out = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

void family(std::ostream& out, const char* name, const char* type, const char* help) {
  out << "# HELP wellspaced_" << name << " " << help << "\n# TYPE wellspaced_" << name << " " << type << "\n";
}

void counters(std::ostream& out, const char* name, const char* help,
              const std::map<std::string, std::uint64_t>& values) {
  family(out, name, "counter", help);
  for (const auto& [labels, value] : values)
    out << "wellspaced_" << name << "{" << labels << "} " << value << "\n";
}

void process(std::ostream& out) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  out << "# HELP process_cpu_seconds_total Processor time used.\n# TYPE process_cpu_seconds_total counter\n"
      << "process_cpu_seconds_total " << seconds(usage.ru_utime) + seconds(usage.ru_stime) << "\n"
      << "# HELP process_resident_memory_bytes Memory in use.\n# TYPE process_resident_memory_bytes gauge\n"
      << "process_resident_memory_bytes " << resident * sysconf(_SC_PAGESIZE) << "\n";
}

}  // namespace

void Metrics::Histogram::add(double seconds) {
  buckets.resize(bucket_seconds.size());
  for (std::size_t b = 0; b < bucket_seconds.size(); ++b) buckets[b] += seconds <= bucket_seconds[b];
  ++count;
  sum += seconds;
}

void Metrics::count_exchange(const http::Exchange& e) {
  // Only known routes and methods become labels: a scanner must not fill the memory with its inventions.
  const std::string route = label("route", e.route.empty() ? "none" : e.route);
  const std::string method = label("method", e.route.empty() ? "other" : e.method);
  const std::lock_guard lock(mutex_);
  ++requests_[route + "," + method + "," + label("code", std::to_string(e.status))];
  request_seconds_[route].add(e.seconds);
}

void Metrics::count_submitted(const std::string& operation) {
  const std::lock_guard lock(mutex_);
  ++submitted_[label("operation", operation)];
}

void Metrics::count_finished(const JobFinished& f) {
  const std::lock_guard lock(mutex_);
  ++finished_[label("operation", f.operation) + "," + label("status", to_string(f.status))];
  run_seconds_[label("operation", f.operation)].add(f.seconds);
}

void Metrics::count_points(std::size_t generated) {
  const std::lock_guard lock(mutex_);
  points_ += generated;
}

void Metrics::count_rejected(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  ++rejected_[label("reason", reason)];
}

std::string Metrics::text(const JobCounts& queue) const {
  std::ostringstream out;
  const std::lock_guard lock(mutex_);
  const auto histograms = [&](const char* name, const char* help,
                              const std::map<std::string, Histogram>& values) {
    family(out, name, "histogram", help);
    for (const auto& [labels, h] : values) {
      for (std::size_t b = 0; b < bucket_seconds.size(); ++b)
        out << "wellspaced_" << name << "_bucket{" << labels << ",le=\"" << bucket_seconds[b] << "\"} "
            << h.buckets[b] << "\n";
      out << "wellspaced_" << name << "_bucket{" << labels << ",le=\"+Inf\"} " << h.count << "\n"
          << "wellspaced_" << name << "_sum{" << labels << "} " << h.sum << "\n"
          << "wellspaced_" << name << "_count{" << labels << "} " << h.count << "\n";
    }
  };
  counters(out, "http_requests_total", "Requests answered.", requests_);
  histograms("http_request_duration_seconds", "Time from a request's head to its answer's end.",
             request_seconds_);
  counters(out, "jobs_submitted_total", "Jobs taken.", submitted_);
  counters(out, "jobs_finished_total", "Jobs that ended.", finished_);
  histograms("job_run_seconds", "Time a job was computed.", run_seconds_);
  counters(out, "rejected_total", "Requests refused before any work.", rejected_);
  family(out, "points_generated_total", "counter", "Points in results.");
  out << "wellspaced_points_generated_total " << points_ << "\n";
  family(out, "job_queue_depth", "gauge", "Jobs waiting.");
  out << "wellspaced_job_queue_depth " << queue.accepted << "\n";
  family(out, "jobs_running", "gauge", "Jobs being computed.");
  out << "wellspaced_jobs_running " << queue.running << "\n";
  family(out, "job_oldest_queued_seconds", "gauge", "Age of the oldest job waiting.");
  out << "wellspaced_job_oldest_queued_seconds " << static_cast<double>(queue.oldest_accepted_ms) / 1000
      << "\n";
  family(out, "build_info", "gauge", "Always 1.");
  out << "wellspaced_build_info{" << label("version", std::string(version())) << "} 1\n";
  process(out);
  return out.str();
}

}  // namespace wellspaced
