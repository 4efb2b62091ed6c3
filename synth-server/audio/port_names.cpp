// SPDX-License-Identifier: MIT
#include "synth-server/audio/port_names.hpp"

#ifdef SPLASH_HAS_JACK
#include <jack/jack.h>

#include <memory>
#endif

namespace splash::synth {
#ifdef SPLASH_HAS_JACK
namespace {

struct CloseClient {
  void operator()(jack_client_t* client) const { jack_client_close(client); }
};
struct FreePorts {
  void operator()(const char** ports) const { jack_free(static_cast<void*>(ports)); }
};

std::vector<std::string> jack_ports(const std::string& device) {
  const std::unique_ptr<jack_client_t, CloseClient> client(
      jack_client_open("synth-server-ports", JackNoStartServer, nullptr));
  if (client == nullptr) return {};
  const std::unique_ptr<const char*, FreePorts> ports(
      jack_get_ports(client.get(), nullptr, JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput));
  std::vector<std::string> names;
  for (const char* const* port = ports.get(); port != nullptr && *port != nullptr; ++port) {
    const std::string name = *port;
    if (name.starts_with(device + ":")) names.push_back(name);
  }
  return names;
}

}  // namespace
#endif

bool jack_knows([[maybe_unused]] const std::string& name) {
#ifdef SPLASH_HAS_JACK
  const std::unique_ptr<jack_client_t, CloseClient> client(
      jack_client_open("synth-server-asks", JackNoStartServer, nullptr));
  const std::unique_ptr<const char*, FreePorts> ports(
      client == nullptr ? nullptr
                        : jack_get_ports(client.get(), ("^" + name + ":").c_str(), nullptr, 0));
  return ports != nullptr;
#else
  return false;
#endif
}

std::vector<std::string> port_names([[maybe_unused]] const std::string& api,
                                    [[maybe_unused]] const std::string& device,
                                    [[maybe_unused]] int channels) {
#ifdef SPLASH_HAS_JACK
  if (api == "jack") {
    std::vector<std::string> names = jack_ports(device);
    if (names.size() >= static_cast<std::size_t>(channels)) {
      names.resize(static_cast<std::size_t>(channels));
      return names;
    }
  }
#endif
  return {};
}

}  // namespace splash::synth
