use super::panics::listen;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::Duration;

/// What came of asking the reader's function once.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer<A> {
    /// It answered.
    Given(A),
    /// It panicked, with these words.
    Panicked(String),
    /// It had not answered when patience ran out.
    Late,
}

/// Asks a function one input after the other, on a thread of its own, up to the first that it does not answer.
///
/// A function that never answers keeps its thread until the program ends.
pub fn answers<I, A>(
    function: &str,
    inputs: &Arc<[I]>,
    yours: impl Fn(&I) -> A + Send + 'static,
    patience: Duration,
) -> Vec<Answer<A>>
where
    I: Send + Sync + 'static,
    A: Send + 'static,
{
    let (send, receive) = channel();
    let asked = Arc::clone(inputs);
    // Its name is what Rust prints before a panic's own words.
    let started = Builder::new().name(format!("your {function}")).spawn(move || {
        let panicked = send.clone();
        listen(move |words| {
            // Nobody is left to hear it once patience has run out.
            _ = panicked.send(Err(words));
            None
        });
        for input in asked.iter() {
            if send.send(Ok(yours(input))).is_err() {
                return;
            }
        }
    });
    let mut answers = Vec::with_capacity(inputs.len());
    if let Err(refused) = started {
        return vec![Answer::Panicked(format!("no thread could be started for it: {refused}"))];
    }
    while answers.len() < inputs.len() {
        match receive.recv_timeout(patience) {
            Ok(Ok(given)) => answers.push(Answer::Given(given)),
            Ok(Err(words)) => answers.push(Answer::Panicked(words)),
            Err(RecvTimeoutError::Timeout) => answers.push(Answer::Late),
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if !matches!(answers.last(), Some(Answer::Given(_))) {
            break;
        }
    }
    answers
}
