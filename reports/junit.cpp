#include "reports/junit.hpp"

#include <fmt/core.h>

#include "reports/case_table.hpp"
#include "reports/digest.hpp"
#include "reports/meaningful.hpp"
#include "reports/text.hpp"

namespace xpr {
namespace {

std::string message_of(const Row& row) {
  if (!measured(row)) return row.note.empty() ? "no reason given" : row.note;
  std::string message = fmt::format("value {}, reference {} (truth error {}), error {} > tolerance {} {}",
                                    value_text(row), reference_text(row), two_digits(row.reference_error),
                                    two_digits(row.error), two_digits(row.tolerance), row.unit == "1" ? "" : row.unit);
  if (row.verdict != Verdict::fail) message.replace(message.find(" > "), 3, ", ");
  return message + "; " + reason_and_note(row);
}

std::string testcase(const CaseResult& result, const Row& row) {
  std::string open =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_escaped(result.info.id), xml_escaped(row.label));
  const std::string message = xml_escaped(message_of(row));
  switch (row.verdict) {
    case Verdict::pass:
      return open + "/>\n";
    case Verdict::fail:
    case Verdict::inconclusive:
      return open + fmt::format("><failure type=\"{}\" message=\"{}\"/></testcase>\n", to_string(row.verdict), message);
    case Verdict::error:
      return open + fmt::format("><error type=\"error\" message=\"{}\"/></testcase>\n", message);
    case Verdict::skipped:
      break;
  }
  return open + fmt::format("><skipped message=\"{}\"/></testcase>\n", message);
}

std::string fault_testcase(const FaultResult& fault) {
  const std::string open = fmt::format("    <testcase classname=\"planted-faults\" name=\"{}\"", xml_escaped(fault.id));
  if (fault.caught) return open + "/>\n";
  const std::string message = fmt::format("{} did not catch it: {} {}", fault.case_id, fault.description, fault.note);
  return open + fmt::format("><failure type=\"not caught\" message=\"{}\"/></testcase>\n", xml_escaped(message));
}

std::string counts_attributes(const Counts& counts) {
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"", counts.total(),
                     counts.fail + counts.inconclusive, counts.error, counts.skipped);
}

}  // namespace

std::string junit_xml(const SuiteResult& suite) {
  Counts faults;
  for (const FaultResult& fault : suite.faults) ++(fault.caught ? faults.pass : faults.fail);
  Counts total = count(suite);
  total.pass += faults.pass;
  total.fail += faults.fail;
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format("<testsuites name=\"xprimeray {}\" {}>\n", xml_escaped(suite.suite), counts_attributes(total));
  for (const CaseResult& result : suite.cases) {
    out += fmt::format("  <testsuite name=\"{}\" {} time=\"{:.3f}\">\n", xml_escaped(result.info.id),
                       counts_attributes(count(result)), result.seconds);
    for (const Row& row : result.rows) out += testcase(result, row);
    out += "  </testsuite>\n";
  }
  if (!suite.faults.empty()) {
    out += fmt::format("  <testsuite name=\"planted-faults\" {}>\n", counts_attributes(faults));
    for (const FaultResult& fault : suite.faults) out += fault_testcase(fault);
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace xpr
