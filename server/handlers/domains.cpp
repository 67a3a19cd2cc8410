#include "server/handlers/domains.h"

#include <charconv>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/document.h"
#include "proto/fields.h"
#include "proto/stored_domain.h"
#include "server/handlers/answer.h"
#include "server/problem.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr int most_domains_a_page = 500;

ordered_json domain_json(const DomainRecord& record) {
  const ordered_json facts = ordered_json::parse(record.spec.facts);
  ordered_json out = {{"id", record.spec.id},
                      {"format", record.spec.format},
                      {"bytes", record.bytes},
                      {"created", timestamp(record.created_ms)},
                      {"expires", timestamp(record.expires_ms)}};
  if (record.spec.allow_self_intersections) out["allow_self_intersections"] = true;
  out.update(facts);
  return out;
}

[[noreturn]] void refuse_parameter(const std::string& name, const char* known) {
  throw Error(ErrorCode::invalid_parameters, "unknown parameter; known here " + std::string(known),
              pointer_token(name));
}

DomainFile read_upload(const http::Request& request) {
  DomainFile file;
  for (const auto& [name, value] : request.query) {
    if (name == "format") {
      file.format = value;
    } else if (name == "allow_self_intersections") {
      if (value != "true" && value != "false")
        throw Error(ErrorCode::invalid_parameters, "allow_self_intersections must be true or false",
                    "/allow_self_intersections");
      file.allow_self_intersections = value == "true";
    } else {
      refuse_parameter(name, "are: format, allow_self_intersections");
    }
  }
  if (file.format.empty()) file.format = domain_format_of(request.header("Content-Type"), request.body);
  file.bytes = request.body;
  return file;
}

struct Page {
  std::string cursor;
  int limit = 50;
};

Page read_page(const http::Request& request) {
  Page page;
  for (const auto& [name, value] : request.query) {
    if (name == "cursor") {
      if (!is_content_id(value))
        throw Error(ErrorCode::invalid_parameters,
                    "not a cursor; take it from the Link header of the page before", "/cursor");
      page.cursor = value;
    } else if (name == "limit") {
      const auto end = std::from_chars(value.data(), value.data() + value.size(), page.limit);
      if (end.ec != std::errc() || end.ptr != value.data() + value.size() || page.limit < 1 ||
          page.limit > most_domains_a_page)
        throw Error(ErrorCode::invalid_parameters, "limit must be a whole number from 1 to 500", "/limit");
    } else {
      refuse_parameter(name, "are: limit, cursor");
    }
  }
  return page;
}

[[noreturn]] void refuse_unknown_domain() {
  throw Error(ErrorCode::no_such_domain,
              "there is no such domain; its time may be over, or its id is mistyped: upload it again");
}

}  // namespace

http::Response post_domain(Context& context, const http::Request& request) {
  if (context.draining)
    throw Error(ErrorCode::draining,
                "the server is stopping and takes no new work; send the request again in a moment");
  try {
    const DomainFile file = read_upload(request);
    auto domain = read_domain_file(file);
    const DomainSpec spec{owner_of(request), content_id(file.bytes), file.format,
                          file.allow_self_intersections, domain_facts(*domain).dump()};
    const auto [record, is_new] = context.store.add_domain(spec, file.bytes);
    context.domains.put(spec.owner, spec.id, std::move(domain), file.bytes.size());
    http::Response response = json_response(domain_json(record).dump() + "\n", is_new ? 201 : 200);
    if (is_new) response.set("Location", "/v1/domains/" + spec.id);
    return response;
  } catch (const Error& error) {
    context.metrics.count_rejected(to_problem(error).type);
    throw;
  }
}

http::Response list_domains(Context& context, const http::Request& request) {
  const Page page = read_page(request);
  const auto records = context.store.list_domains(owner_of(request), page.cursor, page.limit);
  ordered_json domains = ordered_json::array();
  for (const DomainRecord& record : records) domains.push_back(domain_json(record));
  const ordered_json body = {{"domains", std::move(domains)}};
  http::Response response = json_response(body.dump() + "\n");
  if (static_cast<int>(records.size()) == page.limit)
    response.set("Link", "</v1/domains?limit=" + std::to_string(page.limit) +
                             "&cursor=" + records.back().spec.id + ">; rel=\"next\"");
  return response;
}

http::Response get_domain(Context& context, const http::Request& request) {
  const auto record = context.store.find_domain(owner_of(request), request.parameter("id"));
  if (!record) refuse_unknown_domain();
  return json_response(domain_json(*record).dump() + "\n");
}

http::Response delete_domain(Context& context, const http::Request& request) {
  if (!context.store.delete_domain(owner_of(request), request.parameter("id"))) refuse_unknown_domain();
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace wellspaced
