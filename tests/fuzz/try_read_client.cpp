// Stands for mammotwin-try-read beside the fuzz targets, which start it: asks the server whose
// socket MAMMOTWIN_TRY_READ names (try_read_server.cpp), and ends as its answer ended.

#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

bool send(int connection, char* trial) {
  const int both[] = {STDIN_FILENO, STDOUT_FILENO};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof both)] = {};
  iovec text{trial, std::strlen(trial)};
  msghdr message{};
  message.msg_iov = &text;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof both);
  std::memcpy(CMSG_DATA(header), both, sizeof both);
  return sendmsg(connection, &message, 0) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  const char* server = std::getenv("MAMMOTWIN_TRY_READ");
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  if (argc != 2 || !server || std::strlen(server) >= sizeof place.sun_path) return 2;
  std::strcpy(place.sun_path, server);
  const int connection = socket(AF_UNIX, SOCK_STREAM, 0);
  int status = -1;
  if (connect(connection, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 ||
      !send(connection, argv[1]) || read(connection, &status, sizeof status) != sizeof status)
    return 2;
  if (WIFSIGNALED(status)) {
    signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
