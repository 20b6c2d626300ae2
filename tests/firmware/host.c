/* A board without the board: runs an unmodified AVR program in simavr, in real time, with its UART on a pty.
 *
 *   host PROGRAM.hex MCU LINK PINS
 *
 * LINK becomes a symbolic link to the pty; PINS gets a line "CYCLE PORT BIT LEVEL" for each change of a pin that the
 * program drives. Standard input takes lines "PORT BIT LEVEL", levels from outside, and its end ends the program.
 */
#define _GNU_SOURCE
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_hex.h>

enum { CLOCK_HZ = 16000000, SLICE_CYCLES = 4000, PINS_A_PORT = 8, EXTERNAL_INTERRUPTS = 8 };
static const char PORT_LETTERS[] = "ABCDEFGHIJKL";

static avr_t *avr;
static int pty_host;         /* our end of the line */
static int uart_takes_bytes; /* told by the UART's XON and XOFF */
static FILE *pins;

static void die(const char *what) {
    perror(what);
    exit(1);
}

static void pin_changed(struct avr_irq_t *irq, uint32_t level, void *port) {
    (void)irq;
    const char *name = port; /* the port's letter, and the bit behind it */
    fprintf(pins, "%llu %c %c %u\n", (unsigned long long)avr->cycle, name[0], name[1], level & 1);
}

static void watch_pins(void) {
    static char names[sizeof PORT_LETTERS * PINS_A_PORT][2];
    int used = 0;
    for (const char *letter = PORT_LETTERS; *letter; letter++)
        for (int bit = 0; bit < PINS_A_PORT; bit++) {
            avr_irq_t *irq = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(*letter), IOPORT_IRQ_PIN0 + bit);
            if (!irq)
                continue;
            char *name = names[used++];
            name[0] = *letter;
            name[1] = (char)('0' + bit);
            avr_irq_register_notify(irq, pin_changed, name);
        }
}

static void byte_sent(struct avr_irq_t *irq, uint32_t value, void *unused) {
    (void)irq, (void)unused;
    const unsigned char byte = (unsigned char)value;
    if (write(pty_host, &byte, 1) != 1)
        return; /* nobody reads: a line loses bytes then */
}

static void uart_ready(struct avr_irq_t *irq, uint32_t value, void *unused) {
    (void)irq, (void)value, (void)unused;
    uart_takes_bytes = 1;
}

static void uart_full(struct avr_irq_t *irq, uint32_t value, void *unused) {
    (void)irq, (void)value, (void)unused;
    uart_takes_bytes = 0;
}

static void open_line(const char *link) {
    int board_end;
    struct termios raw;
    char name[128];
    memset(&raw, 0, sizeof raw);
    cfmakeraw(&raw);
    if (openpty(&pty_host, &board_end, name, &raw, NULL)) /* board_end stays open: the line outlives its users */
        die("openpty");
    fcntl(pty_host, F_SETFL, O_NONBLOCK);
    unlink(link);
    if (symlink(name, link))
        die(link);
    uint32_t flags = 0; /* neither its own output on the console nor sleeping while it is polled */
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    const uint32_t uart = AVR_IOCTL_UART_GETIRQ('0');
    avr_irq_register_notify(avr_io_getirq(avr, uart, UART_IRQ_OUTPUT), byte_sent, NULL);
    avr_irq_register_notify(avr_io_getirq(avr, uart, UART_IRQ_OUT_XON), uart_ready, NULL);
    avr_irq_register_notify(avr_io_getirq(avr, uart, UART_IRQ_OUT_XOFF), uart_full, NULL);
}

static void receive_bytes(void) {
    unsigned char byte;
    while (uart_takes_bytes && read(pty_host, &byte, 1) == 1)
        avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT), byte);
}

/* A level from outside, now and whenever the pin is an input again. */
static void set_level(char letter, unsigned bit, unsigned level) {
    static uint8_t masks[128], values[128]; /* by the port's letter */
    const uint8_t pin = (uint8_t)(1u << bit);
    uint8_t *mask = &masks[letter & 127], *value = &values[letter & 127];
    *mask |= pin;
    *value = (uint8_t)(level ? *value | pin : *value & ~pin);
    avr_ioport_external_t outside = {.name = (unsigned char)letter, .mask = *mask, .value = *value};
    avr_ioctl(avr, AVR_IOCTL_IOPORT_SET_EXTERNAL(letter), &outside);
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(letter), IOPORT_IRQ_PIN0 + bit), level);
}

/* Takes the lines that have come on standard input; 0 at its end. */
static int take_levels(void) {
    static char line[64];
    static size_t length;
    struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
    while (poll(&input, 1, 0) > 0) {
        if (read(STDIN_FILENO, line + length, 1) != 1)
            return 0;
        if (line[length] != '\n') {
            if (length < sizeof line - 1)
                length++;
            continue;
        }
        line[length] = 0;
        length = 0;
        char letter;
        unsigned bit, level;
        if (sscanf(line, "%c %u %u", &letter, &bit, &level) == 3 && bit < PINS_A_PORT)
            set_level(letter, bit, level);
    }
    return 1;
}

static void load(const char *program, const char *mcu) {
    uint32_t size, base;
    uint8_t *code = read_ihex_file(program, &size, &base);
    avr = avr_make_mcu_by_name(mcu);
    if (!code || !avr)
        die(program);
    avr_init(avr);
    avr->frequency = CLOCK_HZ;
    memcpy(avr->flash + base, code, size);
    avr->codeend = avr->flashend;
    avr->pc = base;
    /* simavr 1.6 polls level-triggered interrupt pins even while they are off, which costs ten times the rest. */
    for (uint8_t number = 0; number < EXTERNAL_INTERRUPTS; number++)
        avr_extint_set_strict_lvl_trig(avr, number, 0);
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Runs a slice after the other, none before its time. */
static void run(void) {
    const double start = seconds();
    while (take_levels()) {
        receive_bytes();
        const avr_cycle_count_t until = avr->cycle + SLICE_CYCLES;
        while (avr->cycle < until) {
            const int state = avr_run(avr);
            if (state == cpu_Done || state == cpu_Crashed)
                return;
        }
        const double ahead = (double)avr->cycle / CLOCK_HZ - (seconds() - start);
        if (ahead > 0)
            usleep((useconds_t)(ahead * 1e6));
        fflush(pins);
    }
}

int main(int count, char **arguments) {
    if (count != 5) {
        fprintf(stderr, "usage: host PROGRAM.hex MCU LINK PINS\n");
        return 2;
    }
    load(arguments[1], arguments[2]);
    pins = fopen(arguments[4], "w");
    if (!pins)
        die(arguments[4]);
    watch_pins();
    open_line(arguments[3]);
    run();
    return 0;
}
