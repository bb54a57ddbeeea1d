//! What a panic of the reader's function said, heard by the panic's hook.
//!
//! A release build aborts at a panic, so nothing comes back from the function to be looked at.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::{Mutex, Once, OnceLock};
use std::thread::park;

/// Makes a sentence of a panic's words, if it is to end the program.
type Tell = Box<dyn FnOnce(String) -> Option<String>>;

thread_local! {
    /// Who is told when this thread panics.
    static TELL: RefCell<Option<Tell>> = const { RefCell::new(None) };
}

static TURN: Mutex<()> = Mutex::new(());
static HOOK: Once = Once::new();
static END: OnceLock<fn(&str) -> !> = OnceLock::new();

/// From now on a panic of a reader's function in a render ends the program by `end`, which gets the sentence.
pub fn end_at_panics(end: fn(&str) -> !) {
    END.get_or_init(|| end);
}

/// Tells `tell` of the next panic of this thread; a release build then keeps the thread until the program ends.
pub fn listen(tell: impl FnOnce(String) -> Option<String> + 'static) {
    HOOK.call_once(|| {
        let usual = take_hook();
        set_hook(Box::new(move |panic| {
            let Some(tell) = TELL.take() else { return usual(panic) };
            // One at a time, or the words of several threads would mingle.
            let turn = TURN.lock();
            usual(panic);
            if let (Some(sentence), Some(end)) = (tell(words(panic.payload())), END.get()) {
                end(&sentence);
            }
            drop(turn);
            // Without a return there is no abort, which would take the program along.
            while cfg!(panic = "abort") {
                park();
            }
        }));
    });
    TELL.replace(Some(Box::new(tell)));
}

/// What a function gives; none once it has panicked and `tell` was told, unless that has ended the program.
pub fn heard<A>(function: impl FnOnce() -> A, tell: impl FnOnce(String) -> String + 'static) -> Option<A> {
    listen(|words| Some(tell(words)));
    let answer = catch_unwind(AssertUnwindSafe(function)).ok();
    TELL.take();
    answer
}

/// What a panic said, on one line.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.map_or_else(|| "no words".into(), |text| text.split_whitespace().collect::<Vec<_>>().join(" "))
}
