#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// One page in Debian's Chromium without a screen, driven over its debugging pipe
/// (chromedevtools.github.io/devtools-protocol).
class Browser {
 public:
  /// Where Chromium is; empty where it is not installed.
  static std::string program();

  /// Starts it with an empty page; `profile` is a folder for its own files.
  /// Throws std::runtime_error where it does not start.
  explicit Browser(const std::filesystem::path& profile);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::filesystem::path& page);

  /// Value of a JavaScript expression. Throws std::runtime_error with what it threw.
  nlohmann::json evaluate(const std::string& expression);
  /// Waits up to half a minute until an expression is true; false if it never is.
  bool wait_until(const std::string& expression);

  /// A real key, pressed where the focus is: "ArrowRight", "Home".
  void press(const std::string& key);
  /// A real click in the middle of the element that a CSS selector finds, shifted by shares of its
  /// size.
  void click(const std::string& selector, double right = 0, double down = 0);

  /// Is there an element with this role and name for a screen reader?
  bool has_accessible(const std::string& role, const std::string& name);

  /// What the page asked for besides itself, and what it complained of, so far.
  const std::vector<std::string>& requests() const { return requests_; }
  const std::vector<std::string>& complaints() const { return complaints_; }

  /// Of all its processes since it started, user and system.
  double cpu_seconds() const;

  nlohmann::json call(const std::string& method,
                      const nlohmann::json& parameters = nlohmann::json::object());

 private:
  nlohmann::json box_at_rest(const std::string& selector);
  nlohmann::json next_message();
  void note(const nlohmann::json& event);

  pid_t process_ = 0;
  int to_ = -1, from_ = -1;
  int last_id_ = 0;
  std::string session_, unread_;
  std::vector<std::string> requests_, complaints_;
};

}  // namespace mammotwin
