// poise: how to turn a held object so that its fingers press least.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "commands.hpp"
#include "files/file_error.hpp"
#include "pictures/plot.hpp"
#include "shape/characters.hpp"

namespace {

enum Status { can_be_held = 0, cannot_be_held = 1, bad_input = 2, defect = 3, undecided = 4 };

void complain(const std::string& problem) {
  std::fputs(("poise: " + poise::harmless(problem) + "\n").c_str(), stderr);
}

/// Writes to standard output; false if not all of it arrived there.
bool print(const std::string& answer) {
  const std::string text = poise::harmless(answer, "\n\t\033");  // which are our own
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return true;
  // A reader that has seen enough (| head) needs no message.
  if (errno != EPIPE)
    complain("cannot write the answer: " + std::generic_category().message(errno));
  return false;
}

int run(int argc, char** argv) {
  const auto asked = poise::read_command_line(argc, argv);
  if (const auto* text = std::get_if<std::string>(&asked))
    return print(*text) ? can_be_held : bad_input;
  const poise::Reply reply = std::get<poise::Run>(asked)();
  if (!print(reply.text)) return bad_input;
  return reply.yes ? can_be_held : reply.proven ? cannot_be_held : undecided;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // write errors are seen where they happen
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const poise::UsageError& error) {
    complain(error.what());
  } catch (const poise::FileError& error) {
    complain(error.what());
  } catch (const poise::OutputError& error) {
    complain(error.what());
  } catch (const poise::InvalidGrasp& error) {
    complain(error.what());
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(std::string("defect in poise, please report it: ") + error.what());
    return defect;
  }
  return bad_input;
}
