#include "tools/service/http/answer.h"

#include <algorithm>
#include <array>
#include <ctime>

#include "tools/service/http/ascii.h"

namespace sgm::service::http {

namespace {

bool isOneOf(std::string_view name, const auto& names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view known) { return sameLetters(known, name); });
}

bool staysInLine(std::string_view text) { return std::none_of(text.begin(), text.end(), isControl); }

bool isFieldName(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    const char lower = lowerLetter(c);
    return (lower >= 'a' && lower <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::string twoDigits(int number) {
  return {static_cast<char>('0' + number / 10), static_cast<char>('0' + number % 10)};
}

}  // namespace

bool mayHaveBody(int status) { return status != 204 && status != 304; }

bool isSendable(const Response& response) {
  if (response.status < 200 || response.status > 599 || !staysInLine(response.type)) return false;
  return std::all_of(response.fields.begin(), response.fields.end(),
                     [](const Field& f) { return isFieldName(f.name) && staysInLine(f.value); });
}

std::string answerHead(const Response& response, const AnswerFrame& frame) {
  constexpr std::array<std::string_view, 5> kFraming = {"Connection", "Content-Length", "Content-Type", "Date",
                                                        "Transfer-Encoding"};
  constexpr std::array<std::array<std::string_view, 2>, 3> kUsual = {
      {{"Cache-Control", "no-store"}, {"Referrer-Policy", "no-referrer"}, {"X-Content-Type-Options", "nosniff"}}};
  std::string head;
  head.reserve(384);
  const auto write = [&](std::string_view name, std::string_view value) {
    (((head += name) += ": ") += value) += "\r\n";
  };
  ((((head += "HTTP/1.1 ") += std::to_string(response.status)) += ' ') += reasonOf(response.status)) += "\r\n";
  if (!frame.date.empty()) write("Date", frame.date);
  if (mayHaveBody(response.status)) {
    if (!response.type.empty()) write("Content-Type", response.type);
    write("Content-Length", std::to_string(response.body ? response.body->size() : 0));
  }
  if (frame.close)
    write("Connection", "close");
  else if (!frame.http11)
    write("Connection", "keep-alive");
  for (const auto& [name, value] : kUsual)
    if (std::none_of(response.fields.begin(), response.fields.end(),
                     [&, usual = name](const Field& f) { return sameLetters(f.name, usual); }))
      write(name, value);
  for (const Field& field : response.fields)
    if (!isOneOf(field.name, kFraming)) write(field.name, field.value);
  return head += "\r\n";
}

std::string httpDate(long long seconds) {
  constexpr std::array<std::string_view, 7> kDays = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array<std::string_view, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                        "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const std::time_t time = seconds;
  std::tm t{};
  if (!gmtime_r(&time, &t)) return {};
  std::string text(kDays[static_cast<size_t>(t.tm_wday)]);
  ((((text += ", ") += twoDigits(t.tm_mday)) += ' ') += kMonths[static_cast<size_t>(t.tm_mon)]) += ' ';
  text += std::to_string(1900 + t.tm_year);
  return text + ' ' + twoDigits(t.tm_hour) + ':' + twoDigits(t.tm_min) + ':' + twoDigits(t.tm_sec) + " GMT";
}

}  // namespace sgm::service::http
