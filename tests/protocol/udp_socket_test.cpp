// SPDX-License-Identifier: MIT
#include "protocol/udp_socket.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

#include "protocol/limits.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kTimeout = 5.0;  // [s]: loopback needs microseconds, a loaded machine more

TEST(UdpSocket, SendsAndReceivesOverLoopback) {
  UdpSocket left(Endpoint{});
  UdpSocket right(Endpoint{});
  ASSERT_NE(left.local().port, 0);
  const Raw packet = message("/ping", ",i", word(5));
  ASSERT_TRUE(left.send_to(right.local(), packet));
  std::array<std::byte, kMaxDatagram> buffer{};
  const auto received = right.receive(buffer.data(), buffer.size(), kTimeout);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->from, left.local());
  EXPECT_EQ(Raw(buffer.begin(), buffer.begin() + static_cast<long>(received->size)), packet);
  EXPECT_FALSE(right.receive(buffer.data(), buffer.size(), 0.0));
}

TEST(UdpSocket, TellsTheRealSizeOfWhatDoesNotFit) {
  UdpSocket left(Endpoint{});
  UdpSocket right(Endpoint{});
  ASSERT_TRUE(left.send_to(right.local(), Raw(5000)));
  ASSERT_TRUE(left.send_to(right.local(), Raw{}));
  std::array<std::byte, kMaxDatagram> buffer{};
  auto received = right.receive(buffer.data(), buffer.size(), kTimeout);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->size, 5000U);
  received = right.receive(buffer.data(), buffer.size(), kTimeout);
  ASSERT_TRUE(received);  // an empty datagram is a datagram
  EXPECT_EQ(received->size, 0U);
}

TEST(UdpSocket, ATakenPortIsAnErrorThatHelps) {
  const UdpSocket holder(Endpoint{});
  EXPECT_THAT([&] { const UdpSocket second(holder.local()); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("UDP port " + std::to_string(holder.local().port)),
                        HasSubstr("Address already in use, another program holds it"),
                        HasSubstr("use --listen host:port"), HasSubstr("port 0"))));
}

TEST(UdpSocket, AnAddressOfAnotherMachineIsAnError) {
  EXPECT_THROW(UdpSocket(Endpoint{0xcb007101U, 0}), std::runtime_error);  // 203.0.113.1
}

TEST(Endpoint, IsLoopbackInTheWholeBlock) {
  EXPECT_TRUE(is_loopback({0x7F000001, 1}));
  EXPECT_TRUE(is_loopback({0x7F123456, 1}));
  EXPECT_FALSE(is_loopback({0x0A000001, 1}));
}

// As the kernel lists it: 127.0.0.1 only, not every network of the machine.
TEST(UdpSocket, IsBoundToLoopbackOnly) {
  const UdpSocket socket(Endpoint{});
  std::ifstream table("/proc/net/udp");
  if (!table) GTEST_SKIP() << "no /proc/net/udp here";
  std::ostringstream port;
  port << ':' << std::hex << std::uppercase << std::setw(4) << std::setfill('0')
       << socket.local().port;
  std::string line;
  int found = 0;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string slot;
    std::string address;
    fields >> slot >> address;
    if (address.size() < 5 || address.substr(address.size() - 5) != port.str()) continue;
    ++found;
    EXPECT_EQ(address.substr(0, 8), "0100007F");
  }
  EXPECT_GE(found, 1) << "while other sockets come and go the kernel may list one twice";
}

TEST(UdpSocket, CountsWhatTheKernelDropped) {
  UdpSocket sender(Endpoint{});
  UdpSocket slow(Endpoint{});
  const Raw packet(1024, std::byte{1});
  // Three times as much as the buffer holds, in the kernel's own count of bytes.
  const std::size_t sent = 3 * slow.receive_buffer() / packet.size();
  for (std::size_t i = 0; i < sent; ++i) ASSERT_TRUE(sender.send_to(slow.local(), packet));
  std::array<std::byte, kMaxDatagram> buffer{};
  std::uint64_t received = 0;
  while (slow.receive(buffer.data(), buffer.size(), 0.0)) ++received;
  ASSERT_LT(received, sent);
  // The count comes with the next datagram.
  ASSERT_TRUE(sender.send_to(slow.local(), packet));
  ASSERT_TRUE(slow.receive(buffer.data(), buffer.size(), kTimeout));
  EXPECT_EQ(slow.dropped_by_kernel(), sent - received);
}

TEST(UdpSocket, AsksForALargeBuffer) {
  const UdpSocket socket(Endpoint{});
  std::size_t allowed = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> allowed;
  if (allowed == 0) GTEST_SKIP() << "no rmem_max here";
  EXPECT_GE(socket.receive_buffer(), std::min<std::size_t>(allowed, 4U << 20U));
}

TEST(UdpSocket, MovesWithItsPort) {
  UdpSocket first(Endpoint{});
  const auto local = first.local();
  UdpSocket second(std::move(first));
  EXPECT_EQ(second.local(), local);
  EXPECT_TRUE(second.send_to(local, Raw(4)));
}

TEST(UdpSocket, AFailedSendIsToldNotThrown) {
  UdpSocket socket(Endpoint{});
  EXPECT_FALSE(socket.send_to(socket.local(), Raw(70000)));  // no datagram is that long
}

TEST(Endpoint, ReadsHostAndPort) {
  EXPECT_EQ(parse_endpoint("127.0.0.1:57310", 1), (Endpoint{0x7f000001U, 57310}));
  EXPECT_EQ(parse_endpoint(":9000", 1), (Endpoint{0x7f000001U, 9000}));
  EXPECT_EQ(parse_endpoint("58110", 1), (Endpoint{0x7f000001U, 58110})) << "no IPv4 number";
  EXPECT_THROW((void)parse_endpoint("65536", 1), std::invalid_argument);
  EXPECT_EQ(parse_endpoint("192.168.1.20", 57310), (Endpoint{0xc0a80114U, 57310}));
  EXPECT_EQ(parse_endpoint("localhost:0", 1), (Endpoint{0x7f000001U, 0}));
  EXPECT_EQ(parse_endpoint("0.0.0.0:5", 1), (Endpoint{0U, 5}));
  EXPECT_EQ(to_string(Endpoint{0xc0a80114U, 57310}), "192.168.1.20:57310");
}

TEST(Endpoint, NamesOptionAndHost) {
  EXPECT_THAT([] { (void)endpoint_of("--target", "256.0.0.1:5", 1); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("--target '256.0.0.1:5': host '256.0.0.1': "),
                        HasSubstr("write another name, or an IPv4 address"))));
}

TEST(Endpoint, SaysWhatIsWrong) {
  for (const char* wrong : {"", "host:", "127.0.0.1:65536", "127.0.0.1:-1", "127.0.0.1:12a", "::1",
                            "1:2:3", "127.0.0.1: 5"}) {
    EXPECT_THAT([&] { (void)parse_endpoint(wrong, 1); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("'" + std::string(wrong) + "'"), HasSubstr("for example"))));
  }
}

}  // namespace
}  // namespace splash::protocol::test
