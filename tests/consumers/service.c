/* A consumer in C of the metrics service: starts the service, and requests /healthz over a socket. */
#include <arpa/inet.h>
#include <sgm/sgm_service.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* Returns 1 if GET /healthz on this port is answered with status 200, otherwise 0. */
static int lives(uint16_t port) {
  const char request[] = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  char answer[64] = {0};
  struct sockaddr_in to;
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  int well;
  memset(&to, 0, sizeof to);
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  well = client >= 0 && connect(client, (const struct sockaddr*)&to, sizeof to) == 0 &&
         write(client, request, sizeof request - 1) == (ssize_t)(sizeof request - 1) &&
         read(client, answer, sizeof answer - 1) > 0 && strncmp(answer, "HTTP/1.1 200 ", 13) == 0;
  close(client);
  return well;
}

int main(void) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_service_desc desc = SGM_SERVICE_DESC_INIT;
  sgm_service* service = NULL;
  uint16_t work = 0, operations = 0;
  int well;

  if (sgm_service_start(&desc, &service, &error) != SGM_OK) {
    fprintf(stderr, "%s: %s\n", sgm_result_name(error.code), error.message);
    return 1;
  }
  well = sgm_service_get_ports(service, &work, &operations, &error) == SGM_OK && work != operations && lives(operations);
  well = sgm_service_stop(service, 1000) == SGM_OK && !lives(operations) && well;
  printf("%s\n", well ? "well" : "not well");
  return well ? 0 : 1;
}
