#include "batch/batch.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>

namespace poise {

void Counts::add(Outcome outcome) {
  ++(outcome == Outcome::answered ? answered : outcome == Outcome::unholdable ? unholdable : bad);
}

void answer_all(Inputs& inputs, const Question& question, Output& output, Counts& counts,
                bool strict, const std::function<void(const Counts&)>& progress) {
  namespace tbb = oneapi::tbb;
  std::size_t records = 0;
  while (records < output.records() && inputs.next()) ++records;
  const auto read = [&](tbb::flow_control& flow) {
    std::optional<Unread> unread = inputs.next();
    if (unread)
      unread->key.record = records++;
    else
      flow.stop();
    return unread;
  };
  const auto answer = [&](const std::optional<Unread>& unread) {
    return answer_record(unread->key, unread->read, question);
  };
  const auto write = [&](const Record& record) {
    if (strict && record.outcome == Outcome::bad)
      throw BadRecord(record.line.substr(0, record.line.size() - 1));
    output.write(record.line);
    counts.add(record.outcome);
    progress(counts);
  };
  // So many under way that a slow one does not hold up the others.
  const auto most = 256 * static_cast<std::size_t>(tbb::info::default_concurrency());
  using Unreads = std::optional<Unread>;
  tbb::parallel_pipeline(
      most, tbb::make_filter<void, Unreads>(tbb::filter_mode::serial_in_order, read) &
                tbb::make_filter<Unreads, Record>(tbb::filter_mode::parallel, answer) &
                tbb::make_filter<Record, void>(tbb::filter_mode::serial_in_order, write));
}

}  // namespace poise
