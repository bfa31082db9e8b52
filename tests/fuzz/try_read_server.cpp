// fuzz_try_read_server SOCKET: mammotwin-try-read, its libraries loaded once. Each request
// (try_read_client.cpp) hands over stdin and stdout, and is answered by a fork that runs what
// mammotwin-try-read runs, with the same limits, and by the status in which it ended.

#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>

int try_read_main(int argc, char** argv);  // main of try_read.cpp

namespace {

struct Request {
  char trial[16] = {};
  int input = -1, output = -1;
};

bool receive(int connection, Request& request) {
  alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))];
  iovec text{request.trial, sizeof request.trial - 1};
  msghdr message{};
  message.msg_iov = &text;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  if (recvmsg(connection, &message, 0) <= 0) return false;
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (!header || header->cmsg_type != SCM_RIGHTS) return false;
  int both[2];
  std::memcpy(both, CMSG_DATA(header), sizeof both);
  request.input = both[0], request.output = both[1];
  return true;
}

[[noreturn]] void try_read(int connection) {
  Request request;
  if (!receive(connection, request)) _exit(1);
  signal(SIGCHLD, SIG_DFL);
  const pid_t child = fork();
  if (child == 0) {
    dup2(request.input, STDIN_FILENO);
    dup2(request.output, STDOUT_FILENO);
    close(connection);
    char name[] = "mammotwin-try-read";
    char* arguments[] = {name, request.trial, nullptr};
    _exit(try_read_main(2, arguments));
  }
  int status = -1;
  waitpid(child, &status, 0);
  _exit(write(connection, &status, sizeof status) == sizeof status ? 0 : 1);
}

}  // namespace

int main(int argc, char** argv) {
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  if (argc != 2 || std::strlen(argv[1]) >= sizeof place.sun_path) return 2;
  std::strcpy(place.sun_path, argv[1]);
  unlink(argv[1]);
  const int listening = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (bind(listening, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 ||
      listen(listening, 8) != 0) {
    std::perror(argv[1]);
    return 1;
  }
  if (!std::freopen("/dev/null", "w", stderr)) return 1;
  signal(SIGCHLD, SIG_IGN);  // nobody asks how an answer ended
  for (;;) {
    const int connection = accept(listening, nullptr, nullptr);
    if (connection < 0) continue;
    if (fork() == 0) try_read(connection);
    close(connection);
  }
}
