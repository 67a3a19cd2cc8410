#include "server/routes.h"

#include "server/handlers/domains.h"
#include "server/handlers/jobs.h"
#include "server/handlers/operations.h"
#include "server/handlers/service.h"

namespace wellspaced {

std::vector<http::Route> routes(Context& context) {
  using http::Request;
  using http::Response;
  const auto bind = [&context](Response (*handler)(Context&, const Request&)) {
    return [&context, handler](const Request& request) { return handler(context, request); };
  };
  const auto operation = [&context](const char* name) {
    return [&context, name](const Request& request) { return post_operation(context, name, request); };
  };
  return {
      {"POST", "/v1/generate", operation("generate")},
      {"POST", "/v1/optimize", operation("optimize")},
      {"POST", "/v1/analyze", operation("analyze")},
      {"POST", "/v1/mesh", operation("mesh")},
      {"GET", "/v1/operations", bind(get_operations)},
      {"GET", "/v1/operations/{operation}", bind(get_operation)},
      {"POST", "/v1/domains", bind(post_domain)},
      {"GET", "/v1/domains", bind(list_domains)},
      {"GET", "/v1/domains/{id}", bind(get_domain)},
      {"DELETE", "/v1/domains/{id}", bind(delete_domain)},
      {"GET", "/v1/jobs", bind(list_jobs)},
      {"GET", "/v1/jobs/{id}", bind(get_job)},
      {"DELETE", "/v1/jobs/{id}", bind(delete_job)},
      {"GET", "/v1/jobs/{id}/events", bind(get_events)},
      {"GET", "/v1/jobs/{id}/result", bind(get_result)},
      {"GET", "/livez", bind(get_livez)},
      {"GET", "/readyz", bind(get_readyz)},
      {"GET", "/version", bind(get_version)},
      {"GET", "/metrics", bind(get_metrics)},
      {"GET", "/openapi.json", bind(get_openapi)},
      {"GET", "/", bind(get_root)},
  };
}

}  // namespace wellspaced
