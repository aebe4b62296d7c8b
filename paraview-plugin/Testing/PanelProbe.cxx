/// Tells what ParaView's properties panel shows, and uses its window as who sits before it, for
/// tests that run inside of ParaView (panel.py, opened.py, far_panel.py): its Python knows no Qt.

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QByteArray>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QString>
#include <QStringList>
#include <QTableWidget>
#include <QTimer>
#include <QTreeView>
#include <QWidget>

#include <utility>

namespace
{

QJsonObject tablesOf(const QWidget& panel)
{
  QJsonObject tables;
  for (const QTableWidget* table : panel.findChildren<QTableWidget*>())
  {
    QJsonArray heads;
    bool whole = true;
    for (int column = 0; table->isVisible() && column < table->columnCount(); ++column)
    {
      const QString head = table->horizontalHeaderItem(column)->text();
      const int room = table->columnWidth(column);
      heads << head;
      whole = whole && table->fontMetrics().horizontalAdvance(head) <= room;
    }
    const QString name = table->parentWidget()->objectName();
    tables[name] = QJsonObject{ { "heads", heads }, { "whole", whole },
      { "rows", table->rowCount() }, { "width", table->width() } };
  }
  return tables;
}

/// The property that the widget is for; what is ParaView's own has none of ours.
QString propertyOf(const QWidget* widget, const QWidget& content)
{
  for (; widget && widget != &content; widget = widget->parentWidget())
  {
    if (widget->inherits("pqPropertyWidget"))
    {
      return widget->objectName();
    }
  }
  return QString();
}

/// Widgets that would have to be narrower: how far each reaches at least, with what it shows.
QJsonArray wideWidgets(const QWidget& content, int width)
{
  QJsonArray wide;
  for (const QWidget* one : content.findChildren<QWidget*>())
  {
    const int right = one->mapTo(&content, QPoint(0, 0)).x() + one->minimumSizeHint().width();
    if (one->isVisible() && right > width && one->findChildren<QWidget*>().isEmpty() &&
      !one->inherits("QScrollBar"))
    {
      const auto* const label = qobject_cast<const QLabel*>(one);
      wide << QJsonObject{ { "class", one->metaObject()->className() }, { "right", right },
        { "property", propertyOf(one, content) }, { "text", label ? label->text() : QString() } };
    }
  }
  return wide;
}

/// The first one that is shown, of that class and name.
template <typename Widget>
Widget* shown(const QWidget& among, const char* name)
{
  for (auto* one : among.findChildren<Widget*>(name))
  {
    if (one->isVisible())
    {
      return one;
    }
  }
  return nullptr;
}

/// Selects the lines of a file dialog that have these names; how many there are.
int selectLines(QTreeView& files, const QStringList& names)
{
  int chosen = 0;
  const QAbstractItemModel& lines = *files.model();
  for (int row = 0; row < lines.rowCount(files.rootIndex()); ++row)
  {
    const QModelIndex line = lines.index(row, 0, files.rootIndex());
    if (names.contains(line.data().toString()))
    {
      files.selectionModel()->select(line,
        (chosen == 0 ? QItemSelectionModel::ClearAndSelect : QItemSelectionModel::Select) |
          QItemSelectionModel::Rows);
      ++chosen;
    }
  }
  return chosen;
}

} // namespace

/// Chooses an action of a menu, once this call is back; false if there is none of that name.
extern "C" Q_DECL_EXPORT bool pointfrontAct(const char* action)
{
  for (const QWidget* window : QApplication::topLevelWidgets())
  {
    if (auto* const found = window->findChild<QAction*>(action))
    {
      QTimer::singleShot(0, found, &QAction::trigger);
      return true;
    }
  }
  return false;
}

/// Selects lines of the open file dialog, whose names are separated by "/", and presses OK once
/// this call is back. How many lines were found: all are needed. -1 while there is no dialog.
extern "C" Q_DECL_EXPORT int pointfrontChoose(const char* names)
{
  for (QWidget* dialog : QApplication::topLevelWidgets())
  {
    if (!dialog->isVisible() || !dialog->inherits("pqFileDialog"))
    {
      continue;
    }
    const QStringList wanted = QString(names).split('/');
    auto* const files = shown<QTreeView>(*dialog, "Files");
    auto* const accept = shown<QAbstractButton>(*dialog, "OK");
    const int chosen = files && accept ? selectLines(*files, wanted) : 0;
    if (chosen == wanted.size())
    {
      QTimer::singleShot(100, accept, &QAbstractButton::click);
    }
    return chosen;
  }
  return -1;
}

/// As who types a line for a property into the panel, in the place of what stands there; false if
/// there is no such line.
extern "C" Q_DECL_EXPORT bool pointfrontType(const char* property, const char* text)
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    if (widget->inherits("pqPropertyWidget") && widget->isVisible() &&
      widget->objectName() == property)
    {
      auto* const line = widget->findChild<QLineEdit*>();
      line ? line->selectAll() : void();
      for (const auto& [key, typed] : { std::pair<int, QString>{ Qt::Key_unknown, text },
             std::pair<int, QString>{ Qt::Key_Return, "\r" } })
      {
        QKeyEvent pressed(QEvent::KeyPress, key, Qt::NoModifier, typed);
        line ? static_cast<void>(QApplication::sendEvent(line, &pressed)) : void();
      }
      return line != nullptr;
    }
  }
  return false;
}

/// Presses a button of the main window; false if none is shown that can be pressed.
extern "C" Q_DECL_EXPORT bool pointfrontPress(const char* name)
{
  for (const QWidget* window : QApplication::topLevelWidgets())
  {
    auto* const button = shown<QAbstractButton>(*window, name);
    if (button && button->isEnabled())
    {
      QTimer::singleShot(0, button, &QAbstractButton::click);
      return true;
    }
  }
  return false;
}

/// JSON, until the next call; "{}" while there is no panel. Called by the thread of the window.
extern "C" Q_DECL_EXPORT const char* pointfrontPanel()
{
  static QByteArray told;
  QJsonObject found;
  for (const QWidget* panel : QApplication::allWidgets())
  {
    if (panel->objectName() != "propertiesPanel")
    {
      continue;
    }
    for (const QScrollArea* area : panel->findChildren<QScrollArea*>())
    {
      if (!area->widget() || !area->isVisible())
      {
        continue;
      }
      const int width = area->viewport()->width();
      found["panel"] = panel->width();
      found["width"] = width;
      found["content"] = area->widget()->minimumSizeHint().width();
      found["sideways"] = area->horizontalScrollBar()->isVisible();
      found["wide"] = wideWidgets(*area->widget(), width);
      found["tables"] = tablesOf(*area->widget());
    }
  }
  told = QJsonDocument(found).toJson(QJsonDocument::Compact);
  return told.constData();
}

/// As who types into a cell of a table; false if there is none.
extern "C" Q_DECL_EXPORT bool pointfrontWrite(
  const char* property, int row, int column, const char* text)
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    auto* const table = qobject_cast<QTableWidget*>(widget);
    if (table && table->isVisible() && table->parentWidget()->objectName() == property)
    {
      QTableWidgetItem* const cell = table->item(row, column);
      cell ? cell->setText(text) : void();
      return cell != nullptr;
    }
  }
  return false;
}
