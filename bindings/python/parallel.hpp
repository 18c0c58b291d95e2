// Independent work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace poise::python {

/// Calls work(0) ... work(size - 1), `chunk` of them at a time on each core. Throws what the first
/// of them to fail throws.
template <class Work>
void parallel(std::size_t size, std::size_t chunk, Work work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto labour = [&] {
    try {
      for (std::size_t from; (from = next.fetch_add(chunk)) < size;)
        for (std::size_t k = from; k < std::min(from + chunk, size); ++k) work(k);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = size;
    }
  };
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t workers = std::min(cores, (size + chunk - 1) / chunk);
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < workers; ++k) others.emplace_back(labour);
  labour();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace poise::python
