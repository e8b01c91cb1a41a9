//! Two threads at one triple buffer: no message is torn, none comes twice, none comes before an older one.

use std::sync::atomic::{AtomicBool, Ordering};

use superhelix::internals::haptics::exchange::exchange;

const NUMBERS: usize = 300;
const MESSAGES: u32 = 200_000;

#[test]
fn messages_are_whole_and_in_order() {
    let (mut publisher, mut taker) = exchange(NUMBERS);
    assert!(taker.take(|_| ()).is_none());
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for message in 1..=MESSAGES {
                publisher.publish(|writer| (0..NUMBERS).for_each(|k| writer.number(f64::from(message) + k as f64)));
            }
            done.store(true, Ordering::Release);
        });
        let (mut last, mut taken) = (0.0, 0);
        loop {
            let is_over = done.load(Ordering::Acquire);
            let message = taker.take(|reader| {
                let first = reader.number();
                assert!((1..NUMBERS).all(|k| reader.number() == first + k as f64), "a torn message");
                first
            });
            if let Some(message) = message {
                assert!(message > last, "{message} after {last}");
                (last, taken) = (message, taken + 1);
            } else if is_over {
                break;
            }
        }
        assert_eq!(last, f64::from(MESSAGES));
        println!("{taken} of {MESSAGES} messages were taken");
        assert!(taken > 1);
    });
}

#[test]
fn the_newest_message_replaces_unread_ones() {
    let (mut publisher, mut taker) = exchange(2);
    for message in 1..=5 {
        publisher.publish(|writer| writer.numbers(&[f64::from(message), -1.0]));
    }
    assert_eq!(taker.take(|reader| reader.numbers::<2>()), Some([5.0, -1.0]));
    assert_eq!(taker.take(|reader| reader.number()), None);
    publisher.publish(|writer| writer.count(7));
    assert_eq!(taker.take(|reader| reader.count()), Some(7));
}

#[test]
fn numbers_beyond_the_capacity_are_dropped() {
    let (mut publisher, mut taker) = exchange(2);
    publisher.publish(|writer| writer.numbers(&[1.0, 2.0, 3.0]));
    assert_eq!(taker.take(|reader| reader.numbers::<3>()), Some([1.0, 2.0, 0.0]));
}
