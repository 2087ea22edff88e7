// What a supervisor such as systemd is told (sd_notify); nothing happens without one.
#pragma once

#include <chrono>
#include <string>

namespace camdir::service {

void tell_ready(const std::string& status);
void tell_reloading();
void tell_stopping();
// The start goes on and needs up to `more` from now.
void tell_starting(const std::string& status, std::chrono::seconds more);
void tell_alive();

}  // namespace camdir::service
