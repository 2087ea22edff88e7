// Notifications to a supervisor such as systemd (sd_notify); without one they do nothing.
#pragma once

#include <chrono>
#include <string>

namespace camdir::service {

void notify_ready(const std::string& status);
void notify_reloading();
void notify_stopping();
// The start is still in progress and needs at most `more` from now.
void notify_starting(const std::string& status, std::chrono::seconds more);
void notify_alive();

}  // namespace camdir::service
