#include "server/http/healthcheck.h"

#include <httplib.h>

namespace wellspaced::http {

int healthcheck(const std::string& host, int port) {
  // A server on all addresses is asked on the loopback one.
  const bool any = host == "0.0.0.0" || host == "::";
  httplib::Client client(any ? "127.0.0.1" : host, port);
  client.set_connection_timeout(5);
  client.set_read_timeout(5);
  const auto response = client.Get("/readyz");
  return response && response->status == 200 ? 0 : 1;
}

}  // namespace wellspaced::http
