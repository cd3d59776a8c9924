#include "simulation/collision_server.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

extern char** environ;

namespace simulation {
namespace {

constexpr std::int32_t kMostWords = 1000;  // bytes of an answer

template <class T>
std::size_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

void CollisionServer::fail(const std::string& cause) const {
  throw std::runtime_error("the collision server '" + command_ + "' " + cause);
}

CollisionServer::CollisionServer(const std::string& command, const onset::Mesh& mesh, const Vector& rest)
    : command_(command) {
  ::signal(SIGPIPE, SIG_IGN);  // a server that ended is an error of the write
  int in[2], out[2];
  if (pipe2(in, O_CLOEXEC) != 0) fail(std::strerror(errno));
  if (pipe2(out, O_CLOEXEC) != 0) {
    ::close(in[0]), ::close(in[1]);
    fail(std::strerror(errno));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::string shell = "/bin/sh", flag = "-c", line = "exec " + command;
  char* arguments[] = {shell.data(), flag.data(), line.data(), nullptr};
  const int error = posix_spawn(&process_, "/bin/sh", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(in[0]), ::close(out[1]);
  to_ = in[1], from_ = out[0];
  if (error != 0) {
    ::close(to_), ::close(from_);
    fail(std::strerror(error));
  }
  const std::int64_t sizes[] = {mesh.num_vertices(), mesh.num_edges(), mesh.num_faces()};
  std::vector<std::int32_t> ids;
  for (std::ptrdiff_t e = 0; e < mesh.num_edges(); ++e)
    for (const int v : mesh.edge(e)) ids.push_back(v);
  for (std::ptrdiff_t f = 0; f < mesh.num_faces(); ++f)
    for (const int v : mesh.face(f)) ids.push_back(v);
  write(sizes, sizeof sizes);
  write(rest.data(), std::size_t(rest.size()) * sizeof(double));
  write(ids.data(), bytes(ids));
}

CollisionServer::~CollisionServer() {
  ::close(to_), ::close(from_);
  int status;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
}

CollisionServer::Answer CollisionServer::ask(const Vector& x_t0, const Vector& x_t1) {
  write(x_t0.data(), std::size_t(x_t0.size()) * sizeof(double));
  write(x_t1.data(), std::size_t(x_t1.size()) * sizeof(double));
  Answer answer;
  std::int32_t size = 0;
  read(&answer.step, sizeof answer.step);
  read(&answer.seconds, sizeof answer.seconds);
  read(&size, sizeof size);
  if (!(answer.step >= 0 && answer.step <= 1) || !(answer.seconds >= 0) || size < 0 || size > kMostWords)
    fail("answered what is no step");
  answer.pair.resize(std::size_t(size));
  read(answer.pair.data(), answer.pair.size());
  return answer;
}

void CollisionServer::write(const void* data, std::size_t size) {
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t done = ::write(to_, from, size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("ended");
    from += done, size -= std::size_t(done);
  }
}

void CollisionServer::read(void* data, std::size_t size) {
  char* to = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t done = ::read(from_, to, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail("ended");
    to += done, size -= std::size_t(done);
  }
}

}  // namespace simulation
