// The one function of the WebAssembly module.
#include <string>

#include "answer.hpp"

/// JSON in, JSON out: see answer.hpp. The text stays until the next call.
extern "C" const char* poise_answer(const char* request) {
  static std::string text;
  text = poise::answer(request);
  return text.c_str();
}
