use clap::Command;
use clap::error::ErrorKind;

/// What was wrong with a command line, in one sentence: clap's own first paragraph, and what would have been accepted.
pub fn sentence(answer: &clap::Error, command: &Command) -> String {
    let text = answer.to_string();
    let paragraphs: Vec<String> = text.split("\n\n").map(on_one_line).collect();
    let wrong = paragraphs.first().map_or("", |first| first.trim_start_matches("error: "));
    let similar = paragraphs.iter().find_map(|paragraph| paragraph.strip_prefix("tip: a similar"));
    if let Some(similar) = similar {
        return format!("{wrong}; a similar{similar}");
    }
    match answer.kind() {
        ErrorKind::InvalidSubcommand => {
            let names: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            format!("{wrong}; the commands are {}", names.join(", "))
        }
        ErrorKind::InvalidValue | ErrorKind::ValueValidation | ErrorKind::ArgumentConflict => wrong.into(),
        _ => format!("{wrong}; --help says what is accepted"),
    }
}

fn on_one_line(paragraph: &str) -> String {
    paragraph.split_whitespace().collect::<Vec<_>>().join(" ")
}
