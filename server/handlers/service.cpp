#include "server/handlers/service.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/openapi.h"
#include "proto/operations.h"
#include "proto/result.h"
#include "server/handlers/answer.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

http::Response text_response(std::string text, const std::string& media_type) {
  http::Response response;
  response.body = std::move(text);
  response.set("Content-Type", media_type).set("Cache-Control", "no-store");
  return response;
}

}  // namespace

http::Response get_livez(Context&, const http::Request&) {
  return text_response("ok\n", "text/plain; charset=utf-8");
}

http::Response get_readyz(Context& context, const http::Request& request) {
  if (context.draining) throw Error(ErrorCode::draining, "the server is stopping");
  context.store.ping();
  const bool verbose = request.target.find("verbose") != std::string::npos;
  return text_response(verbose ? "[ok] not draining\n[ok] store\nready\n" : "ready\n",
                       "text/plain; charset=utf-8");
}

http::Response get_version(Context&, const http::Request&) {
  return json_response(ordered_json{{"name", "wellspaced"}, {"version", version()}}.dump() + "\n");
}

http::Response get_metrics(Context& context, const http::Request&) {
  return text_response(context.metrics.text(context.store.counts()),
                       "text/plain; version=0.0.4; charset=utf-8");
}

http::Response get_openapi(Context& context, const http::Request&) {
  return json_response(openapi_json(context.config.limits).dump(2) + "\n");
}

http::Response get_operations(Context& context, const http::Request&) {
  return json_response(operations_json(context.config.limits).dump() + "\n");
}

http::Response get_operation(Context& context, const http::Request& request) {
  const ordered_json all = operations_json(context.config.limits);
  for (const ordered_json& operation : all["operations"])
    if (operation["name"] == request.parameter("operation")) return json_response(operation.dump() + "\n");
  throw Error(ErrorCode::not_found, "there are the operations generate, optimize, analyze and mesh");
}

http::Response get_root(Context&, const http::Request&) {
  return text_response(
      "wellspaced " + std::string(version()) +
          ": well-spaced blue-noise point sets\n\n"
          "  POST /v1/generate   POST /v1/optimize   POST /v1/analyze   POST /v1/mesh\n"
          "  GET  /v1/operations (methods and their parameters)   GET /openapi.json (the whole contract)\n\n"
          "curl -s HOST/v1/generate -H 'Content-Type: application/json' -d '{\"count\": 1000}'\n",
      "text/plain; charset=utf-8");
}

}  // namespace wellspaced
