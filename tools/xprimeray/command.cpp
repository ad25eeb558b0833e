#include "command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>

#include "core/io/csv.hpp"
#include "core/io/errors.hpp"
#include "integrators/batch_tracer.hpp"

namespace xpr::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

void note_interrupt(int) { interrupt_seen = 1; }

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

void add_output_flags(CLI::App& command, OutputFlags& flags) {
  command.add_flag("--quiet", flags.quiet, "Print nothing but errors");
  command.add_flag("--json", flags.json, "Print one JSON object a line on standard output");
}

void check_lanes(std::string_view command, int lanes) {
  if (lanes == 0 || std::find(lane_widths.begin(), lane_widths.end(), lanes) != lane_widths.end()) return;
  throw InputError(
      fmt::format("{}: --lanes is {}, needs 0 (what this machine does best), 1, 2, 4 or 8", command, lanes));
}

void add_example(CLI::App& command, const std::string& lines) { command.footer("Example:\n" + lines); }

void add_parameter(std::vector<NamedValue>& parameters, const std::string& text) {
  const std::size_t equals = text.find('=');
  NamedValue parameter{std::string_view(text).substr(0, equals)};
  const std::string_view value = equals == std::string::npos ? "" : std::string_view(text).substr(equals + 1);
  if (parse_number(value, parameter.value) != NumberFault::none) {
    throw InputError("--set " + text + ": needs name=number, as in --set a=0.9");
  }
  for (const NamedValue& other : parameters) {
    if (other.name == parameter.name) throw InputError("--set " + text + ": is set twice");
  }
  parameters.push_back(parameter);
}

ProgressLine::ProgressLine(std::string label, bool wanted)
    : label_(std::move(label)), shown_(wanted && ::isatty(STDERR_FILENO) == 1), begin_(seconds_now()) {}

ProgressLine::~ProgressLine() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::update(std::int64_t done, std::int64_t total) {
  const double elapsed = seconds_now() - begin_;
  if (!shown_ || elapsed - last_drawn_ < 0.2) return;
  last_drawn_ = elapsed;
  drawn_ = true;
  const double left = done > 0 ? elapsed * static_cast<double>(total - done) / static_cast<double>(done) : 0.0;
  fmt::print(stderr, "\r\033[K{}: {} of {}, {} left", label_, done, total, duration_text(left));
  std::fflush(stderr);
}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    action.sa_handler = note_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted() { return interrupt_seen != 0; }

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace xpr::cli
