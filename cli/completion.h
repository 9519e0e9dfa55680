/* completion.h: scripts that let a shell complete the words of a command line, from the option tables. */
#ifndef FROE_CLI_COMPLETION_H
#define FROE_CLI_COMPLETION_H

/** Prints the script for "bash", "zsh" or "fish". Returns 0, or an exit code after saying that there is no such shell
 * (NULL: none was given). */
int cli_completion(const char *shell);
#endif
