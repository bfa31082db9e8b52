#include "pipeline/evaluate/page/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr int kPatience_ms = 60000;  // a machine under load draws slowly without a graphics card

[[noreturn]] void become(const std::vector<std::string>& arguments, int in, int out) {
  // Chromium reads commands from descriptor 3 and answers on 4.
  const int safe_in = fcntl(in, F_DUPFD, 10), safe_out = fcntl(out, F_DUPFD, 10);
  dup2(safe_in, 3);
  dup2(safe_out, 4);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int n : {0, 1, 2}) dup2(nowhere, n);
  setpgid(0, 0);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

std::string plain_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// CPU seconds of a process and of its children that ended, if it is of this group (proc(5)).
double cpu_in_group(const std::filesystem::path& process, pid_t group) {
  std::ifstream file(process / "stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::vector<std::string> values;
  for (std::string value; fields >> value;) values.push_back(value);
  constexpr std::size_t kGroup = 2, kUserTicks = 11, kTimes = 4;
  if (values.size() < kUserTicks + kTimes || std::stol(values[kGroup]) != group) return 0;
  double ticks = 0;
  for (std::size_t n = kUserTicks; n < kUserTicks + kTimes; ++n) ticks += std::stod(values[n]);
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

std::string Browser::program() {
  for (const char* path : {"/usr/bin/chromium"})
    if (access(path, X_OK) == 0) return path;
  return "";
}

Browser::Browser(const std::filesystem::path& profile) {
  std::array<int, 2> commands{}, answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("pipe");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("fork");
  // It draws the page itself and leaves WebGL alone to a program that stands in for a graphics
  // card: that program would take sixteen times as long for a page.
  if (process_ == 0)
    become({program(), "--headless=new", "--no-sandbox", "--disable-gpu",
            "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--window-size=1280,900", "--remote-debugging-pipe",
            "--user-data-dir=" + profile.string(), "about:blank"},
           commands[0], answers[1]);
  close(commands[0]);
  close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget",
                  {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Runtime", "Log", "Network", "Page"})
    call(std::string(domain) + ".enable");
}

Browser::~Browser() {
  kill(-process_, SIGKILL);  // its own group: the helpers that it started, too
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  close(to_);
  close(from_);
}

double Browser::cpu_seconds() const {
  double seconds = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc"))
    if (std::isdigit(static_cast<unsigned char>(entry.path().filename().string().front())))
      seconds += cpu_in_group(entry.path(), process_);
  return seconds;
}

json Browser::next_message() {
  for (;;) {
    const std::size_t end = unread_.find('\0');
    if (end != std::string::npos) {
      json message = json::parse(unread_.substr(0, end));
      unread_.erase(0, end + 1);
      return message;
    }
    pollfd wait{from_, POLLIN, 0};
    std::array<char, 65536> buffer{};
    if (poll(&wait, 1, kPatience_ms) <= 0) throw std::runtime_error("Chromium does not answer");
    const ssize_t n = read(from_, buffer.data(), buffer.size());
    if (n <= 0) throw std::runtime_error("Chromium is gone");
    unread_.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

void Browser::note(const json& event) {
  const std::string method = event.value("method", "");
  const json p = event.value("params", json::object());
  if (method == "Network.requestWillBeSent") requests_.push_back(p["request"]["url"]);
  if (method == "Runtime.exceptionThrown") complaints_.push_back(p["exceptionDetails"].dump());
  if (method == "Runtime.consoleAPICalled" && p["type"] == "error")
    complaints_.push_back(p["args"].dump());
  if (method == "Log.entryAdded" && p["entry"]["level"] == "error")
    complaints_.push_back(plain_text(p["entry"]["text"]));
}

json Browser::call(const std::string& method, const json& parameters) {
  json message = {{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(to_, text.data() + sent, text.size() - sent);
    if (n <= 0) throw std::runtime_error("Chromium is gone");
    sent += static_cast<std::size_t>(n);
  }
  for (;;) {
    const json answer = next_message();
    if (answer.value("id", 0) != last_id_) {
      note(answer);
      continue;
    }
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer["result"];
  }
}

void Browser::open(const std::filesystem::path& page) {
  requests_.clear();
  complaints_.clear();
  call("Page.navigate", {{"url", "file://" + page.string()}});
  if (!wait_until("document.readyState === 'complete'"))
    throw std::runtime_error("the page does not load");
}

json Browser::evaluate(const std::string& expression) {
  const json result =
      call("Runtime.evaluate",
           {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (result.contains("exceptionDetails"))
    throw std::runtime_error(result["exceptionDetails"].dump());
  return result["result"].value("value", json());
}

bool Browser::wait_until(const std::string& expression) {
  using namespace std::chrono_literals;
  for (int n = 0; n < 300; ++n) {
    if (evaluate("Boolean(" + expression + ")") == true) return true;
    std::this_thread::sleep_for(100ms);
  }
  return false;
}

void Browser::press(const std::string& key) {
  const std::pair<const char*, int> codes[] = {
      {"End", 35}, {"Home", 36}, {"ArrowLeft", 37}, {"ArrowRight", 39}};
  for (const auto& [name, code] : codes)
    if (key == name)
      for (const char* type : {"rawKeyDown", "keyUp"})
        call("Input.dispatchKeyEvent",
             {{"type", type}, {"key", key}, {"code", key}, {"windowsVirtualKeyCode", code}});
}

/// left, top, width and height of what `selector` finds, scrolled to and no longer moved by the
/// page.
json Browser::box_at_rest(const std::string& selector) {
  return evaluate("(async () => { const e = document.querySelector('" + selector +
                  "'); const drawn = () => new Promise(requestAnimationFrame);"
                  " for (let before = '';;) {"
                  " e.scrollIntoView({block: 'center'}); await drawn(); await drawn();"
                  " const b = e.getBoundingClientRect(), box = [b.left, b.top, b.width, b.height];"
                  " if (String(box) === before) return box;"
                  " before = String(box); } })()");
}

void Browser::click(const std::string& selector, double right, double down) {
  const json box = box_at_rest(selector);
  const double x = box[0].get<double>() + (0.5 + right) * box[2].get<double>();
  const double y = box[1].get<double>() + (0.5 + down) * box[3].get<double>();
  for (const char* type : {"mousePressed", "mouseReleased"})
    call("Input.dispatchMouseEvent",
         {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"clickCount", 1}});
}

bool Browser::has_accessible(const std::string& role, const std::string& name) {
  const json tree = call("Accessibility.getFullAXTree");
  for (const json& node : tree["nodes"])
    if (node.contains("role") && node.contains("name") && node["role"].value("value", "") == role &&
        node["name"].value("value", "") == name)
      return true;
  return false;
}

}  // namespace mammotwin
